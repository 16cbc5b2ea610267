#pragma once
#include "framework/slam/frame.hpp"

namespace ppm {

/// The image of each stride-th pixel of each stride-th row, from pixel (0, 0) on, of every array that the frame has. lateral_px
/// counts in the new pixels: those that are left out do not make those that stay less exact.
Frame decimated(const Frame& frame, int stride);

}  // namespace ppm
