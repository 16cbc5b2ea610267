#include "framework/slam/reprojection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"

namespace ppm {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kSameSurface_m = 0.1, kSamePlace_m = 0.2;
constexpr double kLeastCosine = 0.5;  // between optical axes
constexpr int kOverlapColumns = 16, kErrorColumns = 80;

/// Whether a pixel and its eight neighbours are all measured, within kJump_m.
bool is_smooth(const std::vector<float>& depth, const Camera& camera, int x, int y) {
  if (x == 0 || y == 0 || x == camera.cols - 1 || y == camera.rows - 1) return false;
  float least = std::numeric_limits<float>::infinity(), most = -least;
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u) {
      const float z =
          depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.cols) + static_cast<std::size_t>(u)];
      if (std::isnan(z)) return false;
      least = std::min(least, z);
      most = std::max(most, z);
    }
  return most - least <= PosedImage::kJump_m;
}

/// A point of one image as another camera sees it.
struct Projected {
  Eigen::Vector2d pixel;
  double depth;  // m
};

std::optional<Projected> project(const Pose& T_to_from, const Camera& from, const Camera& to, int x, int y,
                                 double depth) {
  const Eigen::Vector3d p = T_to_from * (depth * from.ray(x, y));
  if (!(p.z() > 0)) return std::nullopt;
  const Eigen::Vector2d pixel = to.project(p);
  const bool inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < to.cols - 1 && pixel.y() < to.rows - 1;
  if (!inside) return std::nullopt;
  return Projected{pixel, p.z()};
}

/// Calls visit(x, y) for a grid of pixels with about so many columns.
template <class F>
void over_grid(const Camera& camera, int columns, const F& visit) {
  const int step = std::max(1, camera.cols / columns);
  for (int y = step / 2; y < camera.rows; y += step)
    for (int x = step / 2; x < camera.cols; x += step) visit(x, y);
}

}  // namespace

PosedImage::PosedImage(const Frame& frame, const Pose& T_map_camera)
    : camera_(frame.camera), T_map_camera_(T_map_camera), depth_(frame.depth), smooth_(frame.depth) {
  for (int y = 0; y < camera_.rows; ++y)
    for (int x = 0; x < camera_.cols; ++x)
      if (!is_smooth(depth_, camera_, x, y)) smooth_[index(x, y)] = kNone;
}

double PosedImage::smooth_depth_at(const Eigen::Vector2d& pixel) const {
  const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
  const double a = pixel.x() - x, b = pixel.y() - y;
  auto inverse = [&](int u, int v) { return 1.0 / static_cast<double>(smooth_depth(u, v)); };
  return 1 / ((1 - b) * ((1 - a) * inverse(x, y) + a * inverse(x + 1, y)) +
              b * ((1 - a) * inverse(x, y + 1) + a * inverse(x + 1, y + 1)));
}

double overlap(const PosedImage& from, const PosedImage& to) {
  const Pose T_to_from = to.T_map_camera().inverse() * from.T_map_camera();
  if (T_to_from.linear()(2, 2) < kLeastCosine) return 0;
  std::size_t points = 0, met = 0;
  over_grid(from.camera(), kOverlapColumns, [&](int x, int y) {
    const float z = from.depth(x, y);
    if (std::isnan(z)) return;
    ++points;
    const auto seen = project(T_to_from, from.camera(), to.camera(), x, y, static_cast<double>(z));
    if (!seen) return;
    const auto there =
        to.depth(static_cast<int>(std::lround(seen->pixel.x())), static_cast<int>(std::lround(seen->pixel.y())));
    met += std::abs(static_cast<double>(there) - seen->depth) <= kSamePlace_m;  // false where nothing is measured
  });
  return points > 0 ? static_cast<double>(met) / static_cast<double>(points) : 0;
}

void ReprojectionScorer::add(const PosedImage& a, const PosedImage& b) {
  ++pairs_;
  add_one_way(a, b);
  add_one_way(b, a);
}

void ReprojectionScorer::add_one_way(const PosedImage& from, const PosedImage& to) {
  const Pose T_to_from = to.T_map_camera().inverse() * from.T_map_camera();
  over_grid(from.camera(), kErrorColumns, [&](int x, int y) {
    const float z = from.smooth_depth(x, y);
    if (std::isnan(z)) return;
    const auto seen = project(T_to_from, from.camera(), to.camera(), x, y, static_cast<double>(z));
    if (!seen) return;
    const double difference = std::abs(to.smooth_depth_at(seen->pixel) - seen->depth);
    if (difference <= kSameSurface_m)
      near_m_.push_back(difference);
    else if (difference > kSameSurface_m)  // neither where nothing is measured
      ++beyond_;
  });
}

ReprojectionError ReprojectionScorer::score() const {
  if (empty()) throw DataError("the images", "no pixel of one is seen by another");
  ReprojectionError error;
  error.pairs = pairs_;
  error.pixels = near_m_.size() + beyond_;
  error.median_mm = 1e3 * quantile(near_m_, 0.5);
  error.mean_mm = 1e3 * mean(near_m_);
  error.beyond_10cm = static_cast<double>(beyond_) / static_cast<double>(error.pixels);
  return error;
}

}  // namespace ppm
