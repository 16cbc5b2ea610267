#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ppm {

enum class PngFormat { gray16, rgb8 };

/// What decode_png found. error is empty when the image is whole.
struct PngImage {
  int cols = 0, rows = 0;
  std::vector<std::uint8_t> bytes;  ///< [rows*cols] native 16-bit values, or [rows*cols*3]
  std::string error;
};

/// Decodes a PNG in memory. gray16 takes 16-bit gray images only; rgb8 converts what there is. Never throws on bad
/// data.
PngImage decode_png(const std::string& file_bytes, PngFormat format);

}  // namespace ppm
