#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm::test {

/// The surface that a map describes, by brute force: every face cut into the small triangles between its texels, each
/// texel moved along its face's normal by its mean; rays are tried against all of them.
class DescribedRays {
 public:
  explicit DescribedRays(const PpmMap& map) {
    for (const auto& chunk : map.table().chunks())
      for (std::size_t f = 0; f < chunk.geometry->face.size(); ++f) add_face(*chunk.geometry, *chunk.texels, f);
  }

  /// Distance along a unit ray to the nearest triangle; infinity where it meets none.
  double distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles_) {
      const Eigen::Vector3d p = direction.cross(t.e2);
      const double det = t.e1.dot(p);
      if (std::abs(det) < 1e-15) continue;
      const Eigen::Vector3d s = origin - t.p;
      const double u = s.dot(p) / det;
      if (u < -1e-9 || u > 1 + 1e-9) continue;
      const Eigen::Vector3d q = s.cross(t.e1);
      const double v = direction.dot(q) / det, r = t.e2.dot(q) / det;
      if (v >= -1e-9 && u + v <= 1 + 1e-9 && r > 0) nearest = std::min(nearest, r);
    }
    return nearest;
  }

 private:
  struct Triangle {
    Eigen::Vector3d p, e1, e2;
  };

  void add_face(const Geometry& g, const Texels& texels, std::size_t f) {
    const auto n = g.divisions[f];
    const Eigen::Vector3d normal = g.face_normal(f).cast<double>();
    auto at = [&](std::uint32_t i, std::uint32_t j) -> Eigen::Vector3d {
      const double mean = texels.mean[g.first_texel[f] + texel_index(n, i, j)];
      return g.point(f, float(i) / float(n), float(j) / float(n)).cast<double>() + mean * normal;
    };
    auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
      triangles_.push_back({a, b - a, c - a});
    };
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 2 <= n) add(at(i + 1, j + 1), at(i, j + 1), at(i + 1, j));
      }
  }
  std::vector<Triangle> triangles_;
};

/// How far two described surfaces are apart, along random rays.
struct SurfaceJump {
  double median = 0, p95 = 0, p99 = 0, most = 0;  ///< m, of |difference of distance|, over rays that meet both
  /// Share of rays that meet one only, or something 5 cm and more from it: at a rim or a fold a ray passes by the
  /// surface and goes on to what is behind.
  double lost = 0;
};

/// Rays from `origin`, uniform over directions within `half_angle` (rad) of `axis`.
inline SurfaceJump surface_jump(const DescribedRays& a, const DescribedRays& b, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& axis, double half_angle, int rays, std::uint32_t seed) {
  Rng rng(seed, 0, 0, purpose_key("rays"));
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  std::vector<double> jump;
  int lost = 0;
  for (int i = 0; i < rays; ++i) {
    const double z = 1 - rng.uniform() * (1 - std::cos(half_angle)), phi = 2 * M_PI * rng.uniform();
    const double r = std::sqrt(1 - z * z);
    const Eigen::Vector3d ray = R * Eigen::Vector3d(r * std::cos(phi), r * std::sin(phi), z);
    const double da = a.distance(origin, ray), db = b.distance(origin, ray);
    if (!std::isfinite(da) && !std::isfinite(db)) continue;
    if (std::abs(da - db) < 0.05)
      jump.push_back(std::abs(da - db));
    else
      ++lost;
  }
  SurfaceJump result;
  result.lost = static_cast<double>(lost) / rays;
  if (jump.empty()) return result;
  std::sort(jump.begin(), jump.end());
  auto quantile = [&](double q) { return jump[static_cast<std::size_t>(q * static_cast<double>(jump.size() - 1))]; };
  result.median = quantile(0.5);
  result.p95 = quantile(0.95);
  result.p99 = quantile(0.99);
  result.most = jump.back();
  return result;
}

}  // namespace ppm::test
