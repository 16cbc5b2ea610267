#pragma once
#include <memory>

#include "framework/slam/chunk_table.hpp"
#include "framework/slam/map.hpp"
#include "modules/maps/points/point_tile.hpp"

namespace ppm {

/// A map of points with normals, thinned so that points of one surface are at least `spacing` apart; in tiles of 32^3
/// spacings that copies share.
/// Source: paper, section 2.1 (the alternative that is registered by ICP); Pfister et al., SIGGRAPH 2000.
class PointMap final : public Map {
 public:
  /// spacing_m: positive (InternalError).
  explicit PointMap(double spacing_m);
  std::string_view kind() const override { return "points"; }
  MapStats stats() const override;
  std::int64_t account(std::unordered_set<const void*>& seen) const override;
  void digest(Digest& digest) const override;
  /// A hexagon a point: the disc that it stands for.
  Mesh mesh(Surface surface) const override;

  double spacing_m() const { return spacing_m_; }
  const ChunkTable<PointChunk>& table() const { return table_; }
  /// The voxel of a place, of all space.
  Cell voxel_of(const Eigen::Vector3f& p) const;
  /// The tile of a voxel.
  static Cell tile_of(const Cell& voxel);

 private:
  friend class PointEdit;
  friend class PointCodec;
  double spacing_m_;
  ChunkTable<PointChunk> table_;
};

}  // namespace ppm
