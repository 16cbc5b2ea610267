#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm::test {

/// What a ray meets.
struct OracleHit {
  double range = INFINITY;
  std::uint32_t chunk = 0xffffffffu, face = 0;
  double u = 0, v = 0;
};

/// Where a ray crosses the plane of a triangle.
struct Crossing {
  double range, u, v;
  double cosine;  ///< of the angle between ray and normal: negative where the triangle is seen from its front
  /// Within the triangle grown by `slack`, a share of it.
  bool inside(double slack) const { return u >= -slack && v >= -slack && u + v <= 1 + slack; }
};

/// None where ray and plane are parallel, or the plane lies behind the origin. direction: unit.
inline std::optional<Crossing> plane_crossing(const Eigen::Vector3d& p0, const Eigen::Vector3d& e1,
                                              const Eigen::Vector3d& e2, const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction) {
  const Eigen::Vector3d n = e1.cross(e2);
  const double along = n.dot(direction);
  if (along == 0) return std::nullopt;
  const double t = n.dot(p0 - origin) / along;
  if (t < 0) return std::nullopt;
  const Eigen::Vector3d q = origin + t * direction - p0;
  const double square = n.squaredNorm();
  return Crossing{t, q.cross(e2).dot(n) / square, e1.cross(q).dot(n) / square, along / std::sqrt(square)};
}

/// Every crossing of the ray with a face of the map whose barycentrics are within the face grown by `slack` (a share of
/// the face), by trying every triangle in double precision; unordered. direction: unit.
inline std::vector<OracleHit> all_hits(const PpmMap& map, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction, bool cull_back_faces, double slack) {
  std::vector<OracleHit> hits;
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& g = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < g.face.size(); ++f) {
      const Eigen::Vector3d p0 = g.position[g.face[f][0]].cast<double>();
      const Eigen::Vector3d e1 = g.position[g.face[f][1]].cast<double>() - p0;
      const Eigen::Vector3d e2 = g.position[g.face[f][2]].cast<double>() - p0;
      const auto hit = plane_crossing(p0, e1, e2, origin, direction);
      if (hit && hit->inside(slack) && !(cull_back_faces && hit->cosine > 0))
        hits.push_back({hit->range, c, f, hit->u, hit->v});
    }
  }
  return hits;
}

inline OracleHit nearest_hit(const std::vector<OracleHit>& hits) {
  OracleHit best;
  for (const auto& h : hits)
    if (h.range < best.range) best = h;
  return best;
}

}  // namespace ppm::test
