#pragma once
#include <cmath>
#include <limits>

#include "framework/slam/frame.hpp"

namespace ppm::test {

constexpr float kNoReturn = std::numeric_limits<float>::quiet_NaN();

/// The image of a plane normal . p = offset in the camera's frame (normal need not be unit).
inline Frame plane_image(const Camera& camera, const Eigen::Vector3d& normal, double offset, float sigma = 0.001f) {
  Frame f;
  f.camera = camera;
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x) f.depth.push_back(static_cast<float>(offset / normal.dot(camera.ray(x, y))));
  f.sigma.assign(f.depth.size(), sigma);
  return f;
}

}  // namespace ppm::test
