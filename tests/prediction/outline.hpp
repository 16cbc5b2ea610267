#pragma once
#include <Eigen/Core>
#include <array>

#include "framework/slam/camera.hpp"

namespace ppm::test {

/// How far a pixel is from the outline of a triangle's image, px; the image of what lies nearer than 0.1 mm along the
/// optical axis is cut off, and INFINITY where nothing is left. corner: m, camera frame.
struct OutlineDistance {
  double px;
  bool inside;
};
OutlineDistance outline_distance(const std::array<Eigen::Vector3d, 3>& corner, const Camera& camera,
                                 const Eigen::Vector2d& pixel);

}  // namespace ppm::test
