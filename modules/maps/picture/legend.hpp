#pragma once
#include "modules/maps/picture/color_scale.hpp"

namespace ppm {

/// Draws the colour scale with its title and values into the lower left corner of a picture.
void draw_legend(RgbImage& image, const ColorScale& scale);

}  // namespace ppm
