#include "framework/core/record_file.hpp"

#include <algorithm>
#include <fstream>

#include "framework/core/digest.hpp"
#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr std::size_t kHashLength = 32;

std::string hash_of(std::string_view payload) {
  Digest digest;
  digest.add(payload.data(), payload.size());
  return digest.hex();
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in || std::filesystem::is_directory(file)) throw DataError(file.string(), "cannot be opened");
  std::string bytes(static_cast<std::size_t>(in.tellg()), '\0');
  in.seekg(0);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw DataError(file.string(), "cannot be read");
  return bytes;
}

}  // namespace

RecordFileWriter::RecordFileWriter(std::filesystem::path file, std::string_view magic) : file_(std::move(file)) {
  PPM_CHECK(magic.size() == 8, "the magic '{}' has not 8 characters", magic);
  file_.write(magic);
  bytes_ = magic.size();
}

void RecordFileWriter::write(const RecordWriter& record) {
  const std::string& payload = record.bytes();
  const auto length = static_cast<std::uint64_t>(payload.size());
  file_.write(&length, sizeof length);
  file_.write(payload);
  file_.write(hash_of(payload));
  bytes_ += sizeof length + length + kHashLength;
}

RecordFileReader::RecordFileReader(const std::filesystem::path& file, std::string_view magic, const std::string& kind)
    : file_(file.string()), bytes_(content_of(file)) {
  const auto length = std::min(bytes_.size(), magic.size());
  if (std::string_view(bytes_).substr(0, length) != magic.substr(0, length)) throw DataError(file_, "is not " + kind);
  if (bytes_.size() < magic.size()) throw DataError(file_, "is cut short");
  at_ = magic.size();
}

RecordReader RecordFileReader::next(const std::string& what) {
  const auto left = bytes_.size() - at_;
  std::uint64_t length = 0;
  auto cut = [&] { throw DataError(file_, fmt::format("is cut short in {} (byte {})", what, bytes_.size())); };
  if (left < sizeof length) cut();
  std::memcpy(&length, bytes_.data() + at_, sizeof length);
  const auto room = left - sizeof length;
  if (room < kHashLength || length > room - kHashLength) cut();
  const auto payload = std::string_view(bytes_).substr(at_ + sizeof length, length);
  const auto hash = std::string_view(bytes_).substr(at_ + sizeof length + length, kHashLength);
  if (hash_of(payload) != hash)
    throw DataError(file_, fmt::format("{} was altered: its checksum differs (bytes {} to {})", what, at_,
                                       at_ + sizeof length + length + kHashLength - 1));
  at_ += sizeof length + length + kHashLength;
  return {payload, file_, what};
}

void RecordFileReader::finish(const std::string& last) const {
  if (at_ != bytes_.size()) throw DataError(file_, fmt::format("goes on after {} (byte {})", last, at_));
}

}  // namespace ppm
