#include "framework/slam/camera_correction.hpp"

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

bool CameraCorrection::changes_depth() const {
  return depth_factor != 1 || depth_bend != 0 || depth_bend_x != 0 || depth_bend_y != 0 || depth_bend_radial != 0;
}

double CameraCorrection::depth(double z, double bend) const {
  const double rest = 1 - bend * z;
  return rest > 0 ? depth_factor * z / rest : std::numeric_limits<double>::quiet_NaN();
}

void correct_depth(const CameraCorrection& correction, Frame& frame) {
  if (!correction.changes_depth()) return;
  const Camera& camera = frame.camera;
  std::size_t p = 0;
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x, ++p) {
      const double z = frame.depth[p], bend = correction.bend(camera.ray(x, y));
      if (!frame.sigma.empty()) frame.sigma[p] *= static_cast<float>(correction.depth_slope(z, bend));
      frame.depth[p] = static_cast<float>(correction.depth(z, bend));
    }
}

}  // namespace ppm
