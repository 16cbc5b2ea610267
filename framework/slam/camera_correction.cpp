#include "framework/slam/camera_correction.hpp"

#include <cmath>
#include <limits>

namespace ppm {

Camera CameraCorrection::camera(const Camera& as_read) const {
  Camera out = as_read;
  out.fx *= focal_scale;
  out.fy *= focal_scale;
  out.cx += cx_shift;
  out.cy += cy_shift;
  return out;
}

double CameraCorrection::depth(double z) const {
  if (!(depth_slope(z) > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (depth_factor + depth_bend * z) * z;
}

void correct_depth(const CameraCorrection& correction, Frame& frame) {
  if (correction.depth_factor == 1 && correction.depth_bend == 0) return;
  for (std::size_t p = 0; p < frame.depth.size(); ++p) {
    const double z = frame.depth[p];
    if (!frame.sigma.empty()) frame.sigma[p] *= static_cast<float>(correction.depth_slope(z));
    frame.depth[p] = static_cast<float>(correction.depth(z));
  }
}

}  // namespace ppm
