#include "modules/rawlog/spool.hpp"

#include <cerrno>
#include <cstring>
#include <unistd.h>
#include <vector>
#include <zlib.h>

#include "framework/core/error.hpp"

namespace ppm {

Spool::Spool(const std::filesystem::path& file) : name_(file.string()), file_(std::fopen(file.c_str(), "rb")) {
  if (!file_) throw DataError(name_, std::strerror(errno));
  unsigned char magic[2] = {};
  if (read(0, magic, 2) == 2 && magic[0] == 0x1f && magic[1] == 0x8b) unpack();
  std::fseek(file_.get(), 0, SEEK_END);
  size_ = static_cast<std::uint64_t>(std::ftell(file_.get()));
}

std::size_t Spool::read(std::uint64_t at, void* out, std::size_t n) const {
  const auto got = ::pread(::fileno(file_.get()), out, n, static_cast<off_t>(at));
  if (got < 0) throw DataError(name_, std::strerror(errno));
  return static_cast<std::size_t>(got);
}

void Spool::unpack() {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> packed(::gzopen(name_.c_str(), "rb"), ::gzclose_r);
  if (!packed) throw DataError(name_, "cannot be opened to be unpacked");
  std::unique_ptr<std::FILE, Close> room(std::tmpfile());
  if (!room) throw OutputError(fmt::format("no temporary file to unpack {} to: {}", name_, std::strerror(errno)));
  std::vector<char> block(1 << 18);
  int got = 0;
  while ((got = ::gzread(packed.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    if (std::fwrite(block.data(), 1, static_cast<std::size_t>(got), room.get()) != static_cast<std::size_t>(got))
      throw OutputError(fmt::format("no room in the temporary folder to unpack {}: {}", name_, std::strerror(errno)));
  }
  int error = Z_OK;
  const char* reason = ::gzerror(packed.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END)
    throw DataError(name_, error == Z_BUF_ERROR ? "is cut short: its gzip stream ends before its time"
                                                : fmt::format("is damaged: {}", reason));
  if (std::fflush(room.get()) != 0)
    throw OutputError(fmt::format("no room in the temporary folder to unpack {}: {}", name_, std::strerror(errno)));
  file_ = std::move(room);
}

}  // namespace ppm
