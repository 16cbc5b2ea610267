#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace ppm {

/// What decode_jpeg found. error is empty when the image is whole.
struct JpegImage {
  int cols = 0, rows = 0;
  std::vector<std::uint8_t> bytes;  ///< [rows*cols*3] RGB
  std::string error;
};

/// Decodes a JPEG in memory to RGB. Never throws on bad data.
JpegImage decode_jpeg(const std::string& file_bytes);

}  // namespace ppm
