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
  bend();
}

void SurfaceView::bend() {
  flat_ = texels;
  for (int row = 0; row < camera.rows; ++row)
    for (int col = 0; col < camera.cols; ++col)
      for (int reach : {kReach, 1})
        if (bend(row, col, reach)) break;
}

bool SurfaceView::bend(int row, int col, int reach) {
  if (row < reach || col < reach || row + reach >= camera.rows || col + reach >= camera.cols) return false;
  const auto next_row = static_cast<std::size_t>(camera.cols), far = static_cast<std::size_t>(reach);
  const auto at = static_cast<std::size_t>(row) * next_row + static_cast<std::size_t>(col);
  const Texel &left = flat_[at - far], &right = flat_[at + far];
  const Texel &above = flat_[at - far * next_row], &below = flat_[at + far * next_row];
  if (left.hit * right.hit * above.hit * below.hit * flat_[at].hit == 0) return false;
  const Eigen::Vector3f across(right.x - left.x, right.y - left.y, right.z - left.z);
  const Eigen::Vector3f down(below.x - above.x, below.y - above.y, below.z - above.z);
  Texel& t = texels[at];
  const Eigen::Vector3f element(t.nx, t.ny, t.nz), cross = across.cross(down);
  const Eigen::Vector3f normal = (cross.dot(element) < 0 ? -1.0f : 1.0f) * cross.normalized();
  if (!(normal.dot(element) > kBend)) return false;
  t.nx = normal.x(), t.ny = normal.y(), t.nz = normal.z();
  return true;
}

}  // namespace ppm
