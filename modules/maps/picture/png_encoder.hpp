#pragma once
#include <string>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

enum class PngEffort { fast, small };
/// The bytes of a PNG file.
std::string to_png(const RgbImage& image, PngEffort effort = PngEffort::small);

}  // namespace ppm
