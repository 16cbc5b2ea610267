#pragma once
#include <string>

#include "modules/maps/picture/palette.hpp"
#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

enum class PngEffort { fast, small };
/// The bytes of a PNG file.
std::string to_png(const RgbImage& image, PngEffort effort = PngEffort::small);
/// With a palette: 1, 2, 4 or 8 bits a pixel, as its colours need.
std::string to_png(const PaletteImage& image);

}  // namespace ppm
