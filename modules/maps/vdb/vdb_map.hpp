#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>

#include "framework/slam/chunk_table.hpp"
#include "framework/slam/map.hpp"
#include "modules/maps/vdb/tile.hpp"

namespace ppm {

/// Fixed when a map is made.
struct VdbSettings {
  double voxel_size_m = 0.02;
  float log_odds_min = -30;  ///< clamps of a voxel's log-odds
  float log_odds_max = 60;
};

/// An occupancy grid: log-odds in OpenVDB nodes, cut into tiles that copies of the map share until they are written.
/// Voxel (i, j, k) is the cube from (i, j, k) * voxel_size to (i+1, j+1, k+1) * voxel_size, map frame; its value is said
/// of its centre. The chunk of cell (i, j, k) holds the voxels from (i, j, k) * kVdbTileEdge on.
/// Source: Thrun, Burgard, Fox, "Probabilistic Robotics", 2005, chapter 9; Museth, "VDB: High-Resolution Sparse Volumes
/// with Dynamic Topology", ACM Transactions on Graphics 2013.
class VdbMap final : public Map {
 public:
  /// An empty map. Throws InternalError where voxel_size_m is not positive, or the clamps do not enclose 0.
  explicit VdbMap(const VdbSettings& settings);
  std::string_view kind() const override { return "vdb"; }
  /// chunks: tiles with anything known in them; texels: voxels that are held one by one.
  MapStats stats() const override;
  std::int64_t account(std::unordered_set<const void*>& seen) const override;
  void digest(Digest& digest) const override;
  /// Surface::base: the faces of voxels that are likelier occupied than free, towards known free ones;
  /// Surface::displaced: where the log-odds between neighbouring voxel centres pass 0. See vdb_mesh.hpp.
  Mesh mesh(Surface surface) const override;

  const VdbSettings& settings() const { return settings_; }
  const ChunkTable<VdbChunk>& table() const { return table_; }
  /// Log-odds of one step of VdbCode: the larger clamp over kVdbMost.
  float step() const { return step_; }
  /// The nearest code of log-odds, within the clamps.
  VdbCode code(float log_odds) const;
  /// The voxel that holds a point.
  Cell voxel_of(const Eigen::Vector3d& p) const {
    return (p / settings_.voxel_size_m).array().floor().cast<int>();
  }
  /// The cell of the chunk that holds a voxel.
  static Cell cell_of(const Cell& voxel) {
    constexpr int shift = kVdbLeafLog2 + kVdbTileLog2;
    return {voxel.x() >> shift, voxel.y() >> shift, voxel.z() >> shift};
  }
  /// A voxel's code, kVdbUnknown where it was never observed. One look-up in the table: not for loops over voxels.
  VdbCode value(const Cell& voxel) const;
  /// A voxel's log-odds; nothing where it was never observed. As slow.
  std::optional<float> log_odds(const Cell& voxel) const;

 private:
  friend class VdbEdit;
  friend class VdbCodec;
  VdbSettings settings_;
  float step_;
  ChunkTable<VdbChunk> table_;
};

}  // namespace ppm
