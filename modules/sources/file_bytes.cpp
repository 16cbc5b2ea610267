#include "modules/sources/file_bytes.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "framework/core/error.hpp"

namespace ppm {

void throw_data_error(const std::filesystem::path& file, std::optional<std::int64_t> frame, const std::string& reason) {
  if (frame) throw DataError(file.string(), *frame, reason);
  throw DataError(file.string(), reason);
}

std::string read_bytes(const std::filesystem::path& file, std::optional<std::int64_t> frame) {
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::unique_ptr<std::FILE, Close> in(std::fopen(file.c_str(), "rb"));
  if (!in) throw_data_error(file, frame, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string bytes;
  char block[1 << 16];
  std::size_t n;
  while ((n = std::fread(block, 1, sizeof block, in.get())) > 0) bytes.append(block, n);
  if (std::ferror(in.get())) throw_data_error(file, frame, fmt::format("cannot be read: {}", std::strerror(errno)));
  return bytes;
}

}  // namespace ppm
