#pragma once
#include <Eigen/Core>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// Draws a straight line with round ends over a picture, anti-aliased. a, b: px; what lies outside is left out.
void draw_stroke(RgbImage& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width_px, const Color& color);

}  // namespace ppm
