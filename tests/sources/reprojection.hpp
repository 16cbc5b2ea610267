#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm::test {

/// The upper median; infinity of nothing.
inline double median(std::vector<double> values) {
  if (values.empty()) return INFINITY;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median absolute difference, m, between the depth of `from`'s pixels seen from `to`, with the reference poses, and
/// what `to` measured there (nearest pixel; differences of 10 cm and more are occlusion and not counted). Wrong signs
/// of axes, a pose inverted, or a wrong depth scale make it centimetres.
inline double reprojection_median(const Frame& from, const Frame& to) {
  const Pose T_to_from = to.T_world_camera_ref->inverse() * *from.T_world_camera_ref;
  std::vector<double> differences;
  for (int y = 0; y < from.camera.rows; y += 2)
    for (int x = 0; x < from.camera.cols; x += 2) {
      const int pixel = y * from.camera.cols + x;
      if (!from.valid(pixel)) continue;
      const Eigen::Vector3d p = T_to_from * (from.depth[static_cast<std::size_t>(pixel)] * from.camera.ray(x, y));
      if (p.z() <= 0) continue;
      const Eigen::Vector2d uv = to.camera.project(p);
      const int u = static_cast<int>(std::lround(uv.x())), v = static_cast<int>(std::lround(uv.y()));
      if (u < 0 || v < 0 || u >= to.camera.cols || v >= to.camera.rows || !to.valid(v * to.camera.cols + u)) continue;
      const double difference = std::abs(to.depth[static_cast<std::size_t>(v * to.camera.cols + u)] - p.z());
      if (difference < 0.1) differences.push_back(difference);
    }
  return median(std::move(differences));
}

}  // namespace ppm::test
