#pragma once
#include "modules/maps/ppm/texel_update.hpp"

namespace ppm::test {

/// The gather form of the texel update as it is said in words, one texel at a time: what gather_faces() is compared
/// with.
class GatherReference {
 public:
  GatherReference(const UpdateView& view, const TexelSettings& settings) : view_(view), settings_(settings) {}

  void update(const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess, float* mean,
              float* variance) const {
    const Eigen::Vector3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const Eigen::Vector3f cross = e1.cross(e2);
    const auto n = static_cast<float>(divisions);
    const Plane plane{cross.normalized(), cross.normalized().dot(corner[0]), cross.norm() / (n * n), excess};
    if (plane.offset >= 0) return;  // seen from behind
    std::size_t t = 0;
    for (std::uint32_t i = 0; i <= divisions; ++i)
      for (std::uint32_t j = 0; i + j <= divisions; ++j, ++t)
        update_texel(plane, corner[0] + e1 * (static_cast<float>(i) / n) + e2 * (static_cast<float>(j) / n), mean[t],
                     variance[t]);
  }

 private:
  struct Plane {
    Eigen::Vector3f normal;
    float offset, texel_area, excess;
  };

  void update_texel(const Plane& plane, const Eigen::Vector3f& node, float& mean, float& variance) const {
    const Eigen::Vector3f image = view_.project(node);
    if (!(image.z() > 0) || image.x() < 0 || image.y() < 0 || image.x() > static_cast<float>(view_.cols() - 1) ||
        image.y() > static_cast<float>(view_.rows() - 1))
      return;
    const auto nearest = view_.at(static_cast<int>(image.x() + 0.5f), static_cast<int>(image.y() + 0.5f));
    if (!view_.measured(nearest)) return;
    const float cosine = std::max(UpdateView::facing(plane.normal, node), settings_.gate.least_cosine);
    const float sigma = view_.sigma[nearest];
    const float limit = settings_.gate_sigmas * settings_.gate.spread(sigma, cosine, variance + plane.excess);
    float offset = 0;
    if (!interpolate(plane, image.x(), image.y(), mean, limit, offset)) return;
    const float pixel = image.z() * view_.inv_fx;
    const float share = std::min(1.0f, plane.texel_area * cosine / (pixel * pixel));
    fuse(mean, variance, offset, variance_along_normal(sigma, cosine, view_.lateral_px * pixel) / share);
  }

  /// The distances of the four points around (x, y) from the plane; false where less than half of the weight is left.
  bool interpolate(const Plane& plane, float x, float y, float mean, float limit, float& offset) const {
    const int x0 = std::min(static_cast<int>(x), view_.cols() - 2),
              y0 = std::min(static_cast<int>(y), view_.rows() - 2);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const std::array<float, 4> weight{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
    float sum = 0, total = 0;
    for (int k = 0; k < 4; ++k) {
      const float r = plane.normal.dot(view_.point[view_.at(x0 + (k & 1), y0 + (k >> 1))]) - plane.offset;
      if (!(std::abs(r - mean) <= limit)) continue;  // also where nothing was measured
      sum += weight[static_cast<std::size_t>(k)] * r;
      total += weight[static_cast<std::size_t>(k)];
    }
    offset = sum / total;
    return total >= 0.5f;
  }

  const UpdateView& view_;
  const TexelSettings& settings_;
};

}  // namespace ppm::test
