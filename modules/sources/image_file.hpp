#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace ppm {

/// A 16-bit gray image, row-major.
struct GrayImage16 {
  int cols = 0, rows = 0;
  std::vector<std::uint16_t> pixels;  ///< [rows*cols]
};

/// An 8-bit colour image, RGB interleaved, row-major.
struct RgbImage {
  int cols = 0, rows = 0;
  std::vector<std::uint8_t> pixels;  ///< [rows*cols*3]
};

/// Images of at most this many pixels a side are read: a broken header must not ask for all memory.
inline constexpr int kMaxImageSide = 8192;

/// Reads a 16-bit gray PNG, values as they are in the file. Throws DataError naming the file, the frame (the source's
/// own number) and the reason: not there, no PNG, cut short, damaged, not 16-bit gray.
GrayImage16 read_gray16_png(const std::filesystem::path& file, std::int64_t frame);

/// Reads a colour image, JPEG or PNG by its first bytes (gray and palette images become RGB, 16 bits become 8, alpha is
/// dropped). Throws DataError as above; a JPEG that decodes only with warnings is damaged.
RgbImage read_rgb_image(const std::filesystem::path& file, std::int64_t frame);

}  // namespace ppm
