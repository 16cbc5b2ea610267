#include "modules/prediction/plane_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/core/error.hpp"

namespace ppm {

void PlaneView::start(const PpmMap& map, PredictionHandle view) {
  PPM_CHECK(view->camera.pixels() < 1 << 24, "a shared view of {} pixels", view->camera.pixels());
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
  Normals normals(pixels.size());
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the last face, camera frame: often the next pixel's too
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (chunk[i] != Prediction::kNone && (i == 0 || chunk[i] != chunk[i - 1] || face[i] != face[i - 1]))
      normal = to_camera * map_->table()[chunk[i]].geometry->face_normal(face[i]);
    normals.x[i] = normal.x(), normals.y[i] = normal.y(), normals.z[i] = normal.z();
  }
  for (int y = rows.first; y < rows.end; ++y) {
    fill_row(y, static_cast<std::size_t>(y - rows.first) * cols, seen, normals);
    close_gaps(y);
  }
}

// Without branches, so that it is vectorised. from: the row's first entry in `seen` and `normals`.
void PlaneView::fill_row(int y, std::size_t from, const ViewSamples& seen, const Normals& normals) {
  constexpr float kLeastCosine = 1e-3f;  // flatter elements are taken for that flat
  constexpr float kLeastRange = 1e-3f;   // m: texels may say that the surface is behind the camera
  const Camera& camera = view_->camera;
  const auto per_fx = static_cast<float>(1 / camera.fx), per_fy = static_cast<float>(1 / camera.fy);
  const float ray_x0 = -static_cast<float>(camera.cx) * per_fx;
  const float ray_y = static_cast<float>(y - camera.cy) * per_fy;
  const float *nx = &normals.x[from], *ny = &normals.y[from], *nz = &normals.z[from];
  const float *range = &seen.range[from], *cosine = &seen.cosine[from], *variance = &seen.variance[from];
  const std::size_t first = static_cast<std::size_t>(y * camera.cols);
  float *disparity = &disparity_[first], *per_x = &per_x_[first], *per_y = &per_y_[first],
        *distance = &distance_[first], *along_normal = &variance_[first];
#pragma GCC ivdep  // the rows of the arrays are apart
  for (int x = 0; x < camera.cols; ++x) {
    const float ray_x = static_cast<float>(x) * per_fx + ray_x0;
    const float per_length = 1 / std::sqrt(ray_x * ray_x + ray_y * ray_y + 1);
    const float facing = (nx[x] * ray_x + ny[x] * ray_y + nz[x]) * per_length;
    const float safe = std::copysign(std::max(std::abs(facing), kLeastCosine), facing);
    const float offset = std::max(range[x], kLeastRange) * safe;  // n . p; infinite at a miss
    const float per_offset = 1 / offset;                          // 0 at a miss
    disparity[x] = safe * per_offset / per_length;
    per_x[x] = nx[x] * per_fx * per_offset;
    per_y[x] = ny[x] * per_fy * per_offset;
    distance[x] = range[x] == Prediction::kMiss ? 0 : std::abs(offset);
    along_normal[x] = variance[x] * cosine[x] * cosine[x];
  }
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
