#include "modules/sources/gzip.hpp"

#include <array>
#include <utility>
#include <zlib.h>

#include "framework/core/error.hpp"

namespace ppm {

Unzipped gunzip(std::string file_bytes) {
  if (!file_bytes.starts_with("\x1f\x8b")) return {std::move(file_bytes), ""};
  z_stream stream{};
  constexpr int kGzipOnly = 15 + 16;  // window bits, and no other format
  PPM_CHECK(inflateInit2(&stream, kGzipOnly) == Z_OK, "zlib does not start");
  stream.next_in = reinterpret_cast<Bytef*>(file_bytes.data());
  stream.avail_in = static_cast<uInt>(file_bytes.size());
  Unzipped out;
  std::array<char, 1 << 16> block;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.bytes.append(block.data(), block.size() - stream.avail_out);
  }
  if (state == Z_BUF_ERROR) out.error = "ends before its time";
  if (state != Z_BUF_ERROR && state != Z_STREAM_END) out.error = stream.msg ? stream.msg : "is damaged";
  inflateEnd(&stream);
  return out;
}

}  // namespace ppm
