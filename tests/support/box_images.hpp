#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm::test {

/// The room [-2, 2] x [-1.5, 1.5] x [-2, 2] m seen from inside: how far the walls are along a ray.
inline double box_range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d half(2, 1.5, 2);
  double range = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) continue;
    range = std::min(range, ((direction[i] > 0 ? half[i] : -half[i]) - origin[i]) / direction[i]);
  }
  return range;
}

/// An exact image of that room.
inline Frame box_image(const Camera& camera, const Pose& T_map_camera) {
  Frame frame;
  frame.camera = camera;
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x) {
      const Eigen::Vector3d ray = T_map_camera.linear() * camera.ray(x, y);
      frame.depth.push_back(
          static_cast<float>(box_range(T_map_camera.translation(), ray.normalized()) / ray.norm()));
    }
  frame.sigma.assign(frame.depth.size(), 0.001f);
  return frame;
}

/// Views of the room all around, slightly off its middle.
inline std::vector<Pose> box_views() {
  std::vector<Pose> views;
  for (int i = 0; i < 8; ++i) {
    Pose T = Pose::Identity();
    T.translation() = Eigen::Vector3d(0.13, -0.07, 0.21) + 0.05 * i * Eigen::Vector3d(1, 0.3, -0.5);
    T.linear() = Eigen::AngleAxisd(i * 0.7853981633974483, Eigen::Vector3d::UnitY()).toRotationMatrix();
    views.push_back(T);
  }
  return views;
}

inline Camera box_camera() {
  return {80, 60, 50, 50, 39.5, 29.5};
}

}  // namespace ppm::test
