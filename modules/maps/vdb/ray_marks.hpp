#pragma once
#include <bitset>
#include <unordered_map>
#include <vector>

#include "framework/slam/frame.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// Where a pixel's ray ends.
struct RayEnd {
  Eigen::Vector3d p_camera;  ///< m
  bool hit;                  ///< at something; else it was cut off
};
/// A ray for each measurement, cut off at max_range_m.
std::vector<RayEnd> ray_ends(const Frame& frame, double max_range_m);

/// The voxels that rays pass, and those in which they end: what OctoMap's computeUpdate() collects. The voxel of the
/// camera is passed, that of an end is not; one that is both passed and hit counts as hit.
/// Source: Hornung et al., "OctoMap", Autonomous Robots 2013; Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray
/// Tracing", Eurographics 1987.
class RayMarks {
 public:
  struct Tile {
    Cell cell;
    /// Bit kVdbLeafVoxels * vdb_leaf() + vdb_voxel().
    std::bitset<kVdbTileLeaves * kVdbLeafVoxels> passed, hit;
  };
  RayMarks(const std::vector<RayEnd>& ends, const Pose& T_map_camera, double voxel_size_m);
  /// In the order in which rays first touch them.
  const std::vector<Tile>& tiles() const { return tiles_; }

 private:
  void follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, bool hit);
  Tile& tile_of(const Cell& voxel);

  std::vector<Tile> tiles_;
  std::unordered_map<Cell, std::size_t, CellHash> number_;
  std::size_t last_ = 0;  // the tile that was asked for last
};

}  // namespace ppm
