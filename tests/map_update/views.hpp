#pragma once
#include <functional>

#include "modules/maps/ppm/update_view.hpp"
#include "tests/map_update/box_world.hpp"

namespace ppm::test {

/// A frame of the small camera whose depth is given for each pixel (x, y); NaN = no return.
inline Frame frame_of(const std::function<float(int, int)>& depth, float sigma = 0.004f) {
  Frame f;
  f.camera = small_camera();
  for (int y = 0; y < f.camera.rows; ++y)
    for (int x = 0; x < f.camera.cols; ++x) {
      f.depth.push_back(depth(x, y));
      f.sigma.push_back(sigma);
    }
  return f;
}

/// A prediction at the identity: face 0 of chunk 0, a plane across the optical axis at the depth given for each pixel;
/// NaN = a miss.
inline Prediction prediction_of(const std::function<float(int, int)>& depth, float variance = 0) {
  Prediction p;
  p.reset(small_camera(), 1, Pose::Identity());
  for (int y = 0; y < p.camera.rows; ++y)
    for (int x = 0; x < p.camera.cols; ++x) {
      const auto i = static_cast<std::size_t>(y * p.camera.cols + x);
      const float z = depth(x, y);
      if (z != z) continue;
      p.range[i] = z * static_cast<float>(p.camera.ray(x, y).norm());
      p.variance[i] = variance;
      p.normal[3 * i + 2] = -1;
      p.chunk[i] = p.face[i] = 0;
    }
  return p;
}

}  // namespace ppm::test
