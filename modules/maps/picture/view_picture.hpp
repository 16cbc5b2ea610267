#pragma once
#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/maps/picture/color_scale.hpp"

namespace ppm {

/// Three pictures of one view: what was measured, what a map says of it, and how far these are apart. All of the same size, a
/// whole number of picture pixels to a pixel of the image, with a line of explanation below.
/// Depth along the optical axis. Dark where nothing was measured.
RgbImage depth_picture(const Frame& frame, const ColorScale& scale);
/// The described surface, with the normals that it shows a registration (SurfaceView), lit from beside the camera. Hatched where nothing is predicted. Arrays filled.
RgbImage prediction_picture(const Prediction& view);
/// |measured - expected range| along the ray. Dark where nothing was measured, hatched where nothing is predicted of what
/// was. view: of the frame's camera, arrays filled.
RgbImage error_picture(const Frame& frame, const Prediction& view, const ColorScale& scale);

/// A scale for depth_picture(): from the nearest to the farthest measured depth but for a hundredth at each end.
ColorScale depth_scale(const Frame& frame);
/// The scale for error_picture(), the same for all: 0 .. 5 cm.
ColorScale error_scale();

}  // namespace ppm
