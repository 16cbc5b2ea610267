#pragma once
#include <vector>

#include "modules/maps/picture/canvas.hpp"

namespace ppm {

/// The edges of a camera's viewing pyramid with a roof over its upper side (image rows grow downwards). size: its
/// depth, m.
std::vector<std::vector<Eigen::Vector3d>> frustum(const Pose& T_map_camera, double size);
/// Draws a camera's path, oldest pose first, with about a dozen cameras on it. scale: pixels a unit of width.
void draw_path(Canvas& canvas, const std::vector<Pose>& path, double scale);

}  // namespace ppm
