#pragma once
#include <string_view>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// Draws small letters, digits and "+-._/" by strokes, anti-aliased, at any size; what else is in the text takes a blank's
/// room. x, y: upper left corner, px. height_px: of a capital or digit.
void draw_text(RgbImage& image, std::string_view text, double x, double y, double height_px, const Color& color);
/// Width of a text in pixels.
double text_width(std::string_view text, double height_px);

}  // namespace ppm
