#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/core/cow.hpp"
#include "framework/slam/chunk_table.hpp"
#include "modules/maps/points/surface_point.hpp"

namespace ppm {

/// The points of one cubic cell of kVoxels^3 voxels, whose edge is the map's spacing.
struct PointTile {
  static constexpr int kVoxels = 32;

  /// Unique for each content that ever existed in this process: key of caches; neither saved nor hashed.
  std::uint64_t id = 0;
  /// By voxel, ascending; within a voxel in the order of their making. A point keeps the voxel that it was made in: it
  /// moves by the noise of its first measurements alone.
  std::vector<SurfacePoint> points;
  Eigen::AlignedBox3f box;  ///< of the discs

  /// Number of a voxel; x, y, z in [0, kVoxels).
  static std::uint16_t voxel(int x, int y, int z) { return static_cast<std::uint16_t>((z * kVoxels + y) * kVoxels + x); }
  /// The points of some voxels that follow each other, first to last.
  std::span<const SurfacePoint> in(std::uint16_t first, std::uint16_t last) const;
  /// Behind the points of its voxel.
  void insert(const SurfacePoint& point);
  /// To be called when a content is complete: a box, an id, and no more memory than it needs.
  void seal();
  std::int64_t bytes() const;
};

/// As a ChunkTable holds it.
struct PointChunk {
  Cow<PointTile> tile;
};

}  // namespace ppm
