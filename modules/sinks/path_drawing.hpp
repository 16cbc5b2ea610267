#pragma once
#include <vector>

#include "framework/slam/particle_set.hpp"
#include "modules/sinks/canvas.hpp"

namespace ppm {

/// Positions along a path, oldest first, m, map frame.
std::vector<Eigen::Vector3d> positions(const std::vector<StampedPose>& path);
/// The edges of a camera's viewing pyramid with a roof over its upper side (image rows grow downwards). size: its
/// depth, m.
std::vector<std::vector<Eigen::Vector3d>> frustum(const Pose& T_map_camera, double size);
/// Draws the paths of all particles thinly, the best one's strongly with about a dozen cameras on it. scale: pixels a
/// unit of width.
void draw_paths(Canvas& canvas, const ParticleSet& belief, double scale);

}  // namespace ppm
