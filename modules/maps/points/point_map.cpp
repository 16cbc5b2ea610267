#include "modules/maps/points/point_map.hpp"

#include "framework/core/error.hpp"

namespace ppm {

PointMap::PointMap(double spacing_m) : spacing_m_(spacing_m) {
  PPM_CHECK(spacing_m > 0, "points {} m apart", spacing_m);
}

Cell PointMap::voxel_of(const Eigen::Vector3f& p) const {
  return (p.cast<double>() / spacing_m_).array().floor().cast<int>();
}

Cell PointMap::tile_of(const Cell& voxel) {
  static_assert((PointTile::kVoxels & (PointTile::kVoxels - 1)) == 0, "a power of two: shifts round down");
  return voxel.unaryExpr([](int v) { return v & ~(PointTile::kVoxels - 1); }) / PointTile::kVoxels;
}

MapStats PointMap::stats() const {
  MapStats stats;
  for (const auto& chunk : table_.chunks()) {
    if (!chunk.tile->points.empty()) ++stats.chunks;
    stats.vertices += static_cast<std::int64_t>(chunk.tile->points.size());
  }
  std::unordered_set<const void*> none;
  stats.bytes = account(none);
  return stats;
}

std::int64_t PointMap::account(std::unordered_set<const void*>& seen) const {
  if (!seen.insert(this).second) return 0;
  std::int64_t bytes = static_cast<std::int64_t>(sizeof *this) + table_.account(seen);
  for (const auto& chunk : table_.chunks())
    if (seen.insert(chunk.tile.get()).second) bytes += chunk.tile->bytes();
  return bytes;
}

void PointMap::digest(Digest& digest) const {
  digest.add(spacing_m_);
  digest.add(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    digest.add(table_.cell(i).data(), 3 * sizeof(int));
    digest.add(table_[i].tile->points);
  }
}

Mesh PointMap::mesh(Surface) const {
  constexpr int kCorners = 6;
  Mesh mesh;
  for (const auto& chunk : table_.chunks()) {
    for (const auto& point : chunk.tile->points) {
      const Eigen::Vector3f n = point.normal.vector(), across = n.unitOrthogonal(), up = n.cross(across);
      const auto first = static_cast<std::uint32_t>(mesh.position.size());
      for (int k = 0; k < kCorners; ++k) {
        const float angle = static_cast<float>(2 * EIGEN_PI) * static_cast<float>(k) / kCorners;
        mesh.position.push_back(point.position + point.radius_m() * (std::cos(angle) * across + std::sin(angle) * up));
        mesh.normal.push_back(n);
        mesh.mean.push_back(0);
        mesh.variance.push_back(point.variance());
      }
      for (std::uint32_t k = 1; k + 1 < kCorners; ++k) mesh.face.push_back({first, first + k, first + k + 1});
    }
  }
  return mesh;
}

}  // namespace ppm
