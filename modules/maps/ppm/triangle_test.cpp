#include "modules/maps/ppm/triangle_test.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

/// Counts what the samples of a triangle say.
class Samples {
 public:
  Samples(const UpdateView& view, const std::vector<std::uint8_t>& classes, const TriangleSettings& settings,
          const Eigen::Vector3f& normal, float offset, float cosine)
      : view_(view), classes_(classes), settings_(settings), normal_(normal), offset_(offset), cosine_(cosine) {}

  void add(int x, int y) {
    const auto p = view_.at(std::clamp(x, 0, view_.cols() - 1), std::clamp(y, 0, view_.rows() - 1));
    ++count_;
    if (!view_.measured(p)) return;
    own_ += classes_[p] & kOwnHit;
    const float distance = normal_.dot(view_.point[p]) - offset_;
    fit_ += std::abs(distance) <= settings_.gate_sigmas * settings_.gate.spread(view_.sigma[p], cosine_, 0);
  }
  void add(const Eigen::Vector2f& p) {
    add(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  }

  bool good() const {
    const auto n = static_cast<float>(count_);
    return static_cast<float>(fit_) >= settings_.fit_share * n && static_cast<float>(own_) <= settings_.own_share * n;
  }

 private:
  const UpdateView& view_;
  const std::vector<std::uint8_t>& classes_;
  const TriangleSettings& settings_;
  Eigen::Vector3f normal_;
  float offset_, cosine_;
  int count_ = 0, fit_ = 0, own_ = 0;
};

/// Calls visit(x, y) for the pixels whose centres lie inside a triangle.
template <class Visit>
void for_pixels_inside(const std::array<Eigen::Vector2f, 3>& t, Visit visit) {
  const float top = std::min({t[0].y(), t[1].y(), t[2].y()}), bottom = std::max({t[0].y(), t[1].y(), t[2].y()});
  for (int y = static_cast<int>(std::ceil(top)); y <= static_cast<int>(std::floor(bottom)); ++y) {
    float left = INFINITY, right = -INFINITY;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2f &a = t[k], &b = t[(k + 1) % 3];
      const auto row = static_cast<float>(y);
      if (std::min(a.y(), b.y()) > row || std::max(a.y(), b.y()) < row || a.y() == b.y()) continue;
      const float x = a.x() + (b.x() - a.x()) * ((row - a.y()) / (b.y() - a.y()));
      left = std::min(left, x);
      right = std::max(right, x);
    }
    for (int x = static_cast<int>(std::ceil(left)); x <= static_cast<int>(std::floor(right)); ++x) visit(x, y);
  }
}

}  // namespace

bool is_surface(const UpdateView& view, const std::vector<std::uint8_t>& classes, const TriangleSettings& settings,
                const std::array<Eigen::Vector3f, 3>& corner, const std::array<Eigen::Vector3f, 3>& normals,
                const std::array<Eigen::Vector2f, 3>& pixel) {
  const Eigen::Vector3f cross = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const float twice_area = cross.norm();
  if (!(twice_area > 1e-7f)) return false;
  const Eigen::Vector3f normal = cross / twice_area;
  const Eigen::Vector3f centroid = (corner[0] + corner[1] + corner[2]) / 3;
  const float cosine = UpdateView::facing(normal, centroid);
  if (cosine < settings.cosine_least) return false;
  if (cosine < settings.steep_cosine && normal.dot(normals[0] + normals[1] + normals[2]) < 3 * settings.steep_agree)
    return false;
  Samples samples(view, classes, settings, normal, normal.dot(centroid), cosine);
  samples.add((pixel[0] + pixel[1] + pixel[2]) / 3);
  for (std::size_t k = 0; k < 3; ++k) samples.add((pixel[k] + pixel[(k + 1) % 3]) / 2);
  for_pixels_inside(pixel, [&](int x, int y) { samples.add(x, y); });
  return samples.good();
}

}  // namespace ppm
