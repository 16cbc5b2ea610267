#include "framework/slam/surface_view.hpp"

#include "framework/core/error.hpp"

namespace ppm {

void SurfaceView::build(const Prediction& view) {
  PPM_CHECK(!view.deferred, "the view's arrays are not filled");
  camera = view.camera;
  T_map_camera = view.T_map_camera;
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  texels.assign(pixels, {});
  const Eigen::Matrix3f R_camera_map = T_map_camera.linear().transpose().cast<float>();
  std::size_t p = 0;
  for (int row = 0; row < camera.rows; ++row) {
    for (int col = 0; col < camera.cols; ++col, ++p) {
      if (view.range[p] == Prediction::kMiss) continue;
      const Eigen::Vector3f ray = camera.ray(col, row).normalized().cast<float>();
      const Eigen::Vector3f normal =
          R_camera_map * Eigen::Vector3f(view.normal[3 * p], view.normal[3 * p + 1], view.normal[3 * p + 2]);
      const Eigen::Vector3f point = view.range[p] * ray + view.mean[p] * normal;
      texels[p] = {point.x(), point.y(), point.z(), normal.x(), normal.y(), normal.z(), view.variance[p], 1};
    }
  }
}

}  // namespace ppm
