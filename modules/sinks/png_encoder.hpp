#pragma once
#include <string>

#include "modules/sinks/canvas.hpp"

namespace ppm {

/// The bytes of a PNG file.
std::string to_png(const RgbImage& image);

}  // namespace ppm
