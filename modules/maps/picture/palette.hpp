#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// A picture in few colours.
struct PaletteImage {
  int cols = 0, rows = 0;
  std::vector<std::array<std::uint8_t, 3>> palette;  ///< at most 256
  std::vector<std::uint8_t> index;                   ///< [rows*cols], row-major, into the palette
};

/// The picture in at most so many colours (2 to 256), each the mean of those that it stands for; unchanged where it has
/// no more. Colours are split where that saves most squared error, at the mean of the channel with the largest
/// variance. Source: Wan, Wong, Prusinkiewicz, "An algorithm for multidimensional data clustering", 1988.
PaletteImage in_palette(const RgbImage& image, int most_colors);

}  // namespace ppm
