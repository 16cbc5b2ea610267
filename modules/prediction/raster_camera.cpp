#include "modules/prediction/raster_camera.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

/// Image coordinates up to twice the image's size must fit in 16 bits.
int fraction_bits(int largest_side) {
  int bits = 0;
  while (bits < 7 && (largest_side << (bits + 1)) <= 16000) ++bits;
  return bits;
}

}  // namespace

RasterCamera raster_camera(const Camera& camera, const Pose& T_map_camera, bool cull) {
  const bool fits = std::max(camera.cols, camera.rows) < (1 << 15) && camera.pixels() < (1 << 24);
  PPM_CHECK(fits, "an image of {}x{} pixels", camera.cols, camera.rows);
  RasterCamera c{};
  c.cols = camera.cols;
  c.rows = c.end_row = camera.rows;
  c.middle_x = camera.cols / 2;
  c.middle_y = camera.rows / 2;
  c.cull = cull;
  c.fraction_bits = fraction_bits(std::max(camera.cols, camera.rows));
  const double offset_x = camera.cx - c.middle_x, offset_y = camera.cy - c.middle_y;
  Eigen::Matrix3d image_camera;
  image_camera << camera.fx, 0, offset_x, 0, camera.fy, offset_y, 0, 0, 1;
  const Eigen::Matrix3d axes = image_camera * T_map_camera.linear().transpose();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c.axes[i][j] = static_cast<float>(axes(i, j));
    const double centre = T_map_camera.translation()[i];
    c.centre[i] = static_cast<float>(centre);
    c.centre_rest[i] = static_cast<float>(centre - c.centre[i]);
  }
  c.focal_x = static_cast<float>(camera.fx);
  c.focal_y = static_cast<float>(camera.fy);
  c.offset_x = static_cast<float>(offset_x);
  c.offset_y = static_cast<float>(offset_y);
  c.ray_x = static_cast<float>(1 / camera.fx);
  c.ray_y = static_cast<float>(1 / camera.fy);
  c.ray_x0 = static_cast<float>(-offset_x / camera.fx);
  c.ray_y0 = static_cast<float>(-offset_y / camera.fy);
  c.front = camera.fx * camera.fy > 0 ? -1.f : 1.f;
  return c;
}

}  // namespace ppm
