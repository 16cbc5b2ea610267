#pragma once
#include <string>
#include <string_view>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// The picture of a PNG file's bytes; transparency is laid on white. Throws DataError naming `file` where they are
/// none.
RgbImage from_png(std::string_view bytes, const std::string& file);

/// The picture at most so wide: blocks of pixels become their mean. What is left over at the right and the bottom is
/// cut.
RgbImage shrunk(const RgbImage& image, int most_cols);

}  // namespace ppm
