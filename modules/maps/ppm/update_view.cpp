#include "modules/maps/ppm/update_view.hpp"

#include "framework/core/error.hpp"

namespace ppm {

void UpdateView::set_camera(const Camera& grid, const Pose& T_map_camera) {
  if (inverse_length_.empty() || !(grid == camera)) {
    inverse_length_.resize(static_cast<std::size_t>(grid.pixels()));
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.cols; ++x)
        inverse_length_[static_cast<std::size_t>(y * grid.cols + x)] = static_cast<float>(1 / grid.ray(x, y).norm());
  }
  camera = grid;
  fx = static_cast<float>(camera.fx);
  fy = static_cast<float>(camera.fy);
  cx = static_cast<float>(camera.cx);
  cy = static_cast<float>(camera.cy);
  inv_fx = static_cast<float>(1.0 / camera.fx);
  inv_fy = static_cast<float>(1.0 / camera.fy);
  axes = T_map_camera.linear().cast<float>();
  centre = T_map_camera.translation();
}

void UpdateView::build(const Frame& frame, const Prediction& seen, const Workers& workers) {
  PPM_CHECK(seen.camera == frame.camera.decimated(seen.stride), "the prediction is not one of frame {}'s camera",
            frame.index);
  PPM_CHECK(seen.camera.cols > 1 && seen.camera.rows > 1, "an image of {}x{} pixels shows no surface", seen.camera.cols,
            seen.camera.rows);
  set_camera(seen.camera, seen.T_map_camera);
  prediction = &seen;
  lateral_px = frame.lateral_px / static_cast<float>(seen.stride);
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  depth.resize(pixels);
  sigma.resize(pixels);
  point.resize(pixels);
  normal.resize(pixels);
  offset.resize(pixels);
  for_each_row(workers, camera.rows, [&](int y) {
    const auto row = static_cast<std::size_t>(y * seen.stride) * static_cast<std::size_t>(frame.camera.cols);
    for (int x = 0; x < camera.cols; ++x) {
      const auto p = at(x, y);
      const auto source = row + static_cast<std::size_t>(x * seen.stride);
      const Eigen::Vector3f r = ray(static_cast<float>(x), static_cast<float>(y));
      depth[p] = frame.depth[source];
      sigma[p] = frame.sigma[source];
      point[p] = depth[p] * r;
      normal[p] = Eigen::Vector3f(seen.normal[3 * p], seen.normal[3 * p + 1], seen.normal[3 * p + 2]);
      offset[p] = seen.hit(p) ? seen.range[p] * (normal[p].dot(r) * inverse_length_[p]) + seen.mean[p] : 0.0f;
    }
  });
}

}  // namespace ppm
