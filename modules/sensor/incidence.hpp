#pragma once
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm {

/// The angle at which each pixel's ray meets the surface, from the image alone. Planes are linear in inverse depth over the
/// image; its slope is taken along the row and the column over `baseline` rad, on whichever side it is smaller, so that the
/// surface beyond a depth jump does not count.
/// Returns [rows*cols] cosine of the angle, in (0, 1]; NaN where there is no return or too few neighbours to tell.
std::vector<float> incidence_cosine(const Frame& frame, double baseline);

}  // namespace ppm
