#include "modules/prediction/plane_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppm {

void PlaneView::start(const PpmMap& map, PredictionHandle view) {
  map_ = &map;
  view_ = std::move(view);
  whole_.reset();
  for (auto* array : {&disparity_, &per_x_, &per_y_, &distance_, &variance_})
    array->resize(static_cast<std::size_t>(view_->camera.pixels()));
}

void PlaneView::fill(const Rows& rows) {
  const Camera& camera = view_->camera;
  const auto cols = static_cast<std::size_t>(camera.cols);
  const std::size_t first = static_cast<std::size_t>(rows.first) * cols;
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(rows.end) * cols - first);
  std::iota(pixels.begin(), pixels.end(), static_cast<std::uint32_t>(first));
  ViewSamples seen;
  seen.resize(pixels.size());
  view_->sample(pixels, seen);
  std::vector<std::uint32_t> chunk(pixels.size()), face(pixels.size());
  view_->elements(rows, chunk, face);

  const Eigen::Matrix3f to_camera = view_->T_map_camera.linear().transpose().cast<float>();
  Eigen::Vector3f normal;  // of the last face, camera frame: often the next pixel's too
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t p = first + i;
    disparity_[p] = per_x_[p] = per_y_[p] = distance_[p] = variance_[p] = 0;
    if (chunk[i] == Prediction::kNone) continue;
    if (i == 0 || chunk[i] != chunk[i - 1] || face[i] != face[i - 1])
      normal = to_camera * map_->table()[chunk[i]].geometry->face_normal(face[i]);
    const Eigen::Vector3f ray =
        camera.ray(static_cast<double>(p % cols), static_cast<double>(p / cols)).cast<float>();
    set_plane(p, ray, normal, seen.range[i]);
    variance_[p] = seen.variance[i] * seen.cosine[i] * seen.cosine[i];
  }
  for (int y = rows.first; y < rows.end; ++y) close_gaps(y);
}

void PlaneView::set_plane(std::size_t p, const Eigen::Vector3f& ray, const Eigen::Vector3f& normal, float range) {
  constexpr float kLeastCosine = 1e-3f;  // flatter elements are taken for that flat
  constexpr float kLeastRange = 1e-3f;   // m: texels may say that the surface is behind the camera
  const float length = ray.norm(), z = std::max(range, kLeastRange) / length;
  float along = normal.dot(ray);
  if (std::abs(along) < kLeastCosine * length) along = std::copysign(kLeastCosine * length, along);
  const auto fx = static_cast<float>(view_->camera.fx), fy = static_cast<float>(view_->camera.fy);
  disparity_[p] = 1 / z;
  per_x_[p] = normal.x() / (fx * z * along);
  per_y_[p] = normal.y() / (fy * z * along);
  distance_[p] = z * std::abs(along);
}

// Gaps move with the surface around them: a run of misses in a row takes the smaller disparity of its two ends.
void PlaneView::close_gaps(int y) {
  const auto cols = static_cast<std::size_t>(view_->camera.cols);
  const std::size_t begin = static_cast<std::size_t>(y) * cols, end = begin + cols;
  for (std::size_t p = begin; p < end; ++p) {
    if (distance_[p] > 0) continue;
    std::size_t after = p;
    while (after < end && distance_[after] == 0) ++after;
    const float left = p > begin ? disparity_[p - 1] : 0, right = after < end ? disparity_[after] : 0;
    const float beside = p > begin && after < end ? std::min(left, right) : std::max(left, right);
    std::fill(&disparity_[p], &disparity_[after], beside);
    p = after;
  }
}

PlaneArrays PlaneView::arrays() const {
  return {view_->camera.cols, view_->camera.rows, disparity_.data(), per_x_.data(),
          per_y_.data(),      distance_.data(),   variance_.data()};
}

const Prediction& PlaneView::whole() const {
  std::lock_guard lock(mutex_);
  if (!whole_) {
    auto out = std::make_shared<Prediction>();
    out->reset(view_->camera, view_->stride, view_->T_map_camera, view_->color_channels);
    view_->deferred->fill(*view_, all_rows(view_->camera), *out);
    whole_ = std::move(out);
  }
  return *whole_;
}

}  // namespace ppm
