#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm::test {

/// What a ray meets, by trying every triangle in double precision.
struct OracleHit {
  double range = INFINITY;
  std::uint32_t chunk = 0xffffffffu, face = 0;
  double u = 0, v = 0;
};

/// Every crossing of the ray with a face of the map whose barycentrics are within the face grown by `slack` (a share of
/// the face), unordered. direction: unit.
inline std::vector<OracleHit> all_hits(const PpmMap& map, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction, bool cull_back_faces, double slack) {
  std::vector<OracleHit> hits;
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& g = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < g.face.size(); ++f) {
      const Eigen::Vector3d p0 = g.position[g.face[f][0]].cast<double>();
      const Eigen::Vector3d e1 = g.position[g.face[f][1]].cast<double>() - p0;
      const Eigen::Vector3d e2 = g.position[g.face[f][2]].cast<double>() - p0;
      const Eigen::Vector3d n = e1.cross(e2);
      const double along = n.dot(direction);
      if (along == 0 || (cull_back_faces && along > 0)) continue;
      const double t = n.dot(p0 - origin) / along;
      if (t < 0) continue;
      const Eigen::Vector3d q = origin + t * direction - p0;
      const double u = q.cross(e2).dot(n) / n.squaredNorm(), v = e1.cross(q).dot(n) / n.squaredNorm();
      if (u < -slack || v < -slack || u + v > 1 + slack) continue;
      hits.push_back({t, c, f, u, v});
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
