#include "modules/rawlog/object_stream.hpp"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/io/CStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "framework/core/error.hpp"

namespace ppm {

/// The spool as a stream of MRPT's, read in blocks.
struct ObjectStream::Bytes final : mrpt::io::CStream {
  explicit Bytes(const Spool& spool) : spool_(spool), block_(1 << 18) {}

  std::size_t Read(void* out, std::size_t n) override {
    std::size_t done = 0;
    while (done < n) {
      if (at_ == filled_) {
        first_ += filled_;
        filled_ = spool_.read(first_, block_.data(), block_.size());
        at_ = 0;
        if (filled_ == 0) break;
      }
      const std::size_t some = std::min(n - done, filled_ - at_);
      std::memcpy(static_cast<char*>(out) + done, block_.data() + at_, some);
      at_ += some;
      done += some;
    }
    return done;
  }
  std::uint64_t getPosition() const override { return first_ + at_; }
  std::uint64_t getTotalBytesCount() const override { return spool_.size(); }
  std::size_t Write(const void*, std::size_t) override { throw std::logic_error("the stream is for reading"); }
  std::uint64_t Seek(int64_t, TSeekOrigin) override { throw std::logic_error("the stream goes on only"); }

  const Spool& spool_;
  std::vector<char> block_;
  std::uint64_t first_ = 0;  // of the block in the file
  std::size_t at_ = 0, filled_ = 0;
};

ObjectStream::ObjectStream(const Spool& spool, std::string name)
    : name_(std::move(name)), size_(spool.size()), bytes_(std::make_unique<Bytes>(spool)) {}

ObjectStream::~ObjectStream() = default;

std::uint64_t ObjectStream::end() const {
  return bytes_->getPosition();
}

mrpt::serialization::CSerializable::Ptr ObjectStream::next() {
  begin_ = bytes_->getPosition();
  if (begin_ == size_) return nullptr;
  try {
    auto object = mrpt::serialization::archiveFrom(*bytes_).ReadObject();
    if (!object) throw std::runtime_error("an empty object");
    ++entry_;
    return object;
  } catch (const std::exception& error) {
    const bool short_of = bytes_->getPosition() == size_;
    throw DataError(name_, fmt::format("entry {}, from byte {} on: {}: {}", entry_, begin_,
                                       short_of ? "the file is cut short" : "no observation that MRPT can read",
                                       reason_of(error)));
  }
}

mrpt::serialization::CSerializable::Ptr object_at(const Spool& spool, std::uint64_t begin, std::uint64_t end) {
  std::vector<char> bytes(end - begin);
  for (std::size_t done = 0; done < bytes.size();) {
    const std::size_t got = spool.read(begin + done, bytes.data() + done, bytes.size() - done);
    if (got == 0) throw std::runtime_error("the file has become shorter");
    done += got;
  }
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(stream).ReadObject();
}

std::string reason_of(const std::exception& error) {
  std::string line = error.what();
  for (const std::string mark : {"Message:", "Location:"}) {
    const auto at = line.find(mark);
    if (at == std::string::npos) continue;
    line.erase(0, line.find_first_not_of(" \t\n", at + mark.size()));
    break;
  }
  return line.substr(0, line.find('\n'));
}

}  // namespace ppm
