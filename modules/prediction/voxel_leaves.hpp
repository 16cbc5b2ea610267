#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// The largest integer not above x. (std::floor is a call on processors without SSE 4.1.)
inline int floor_of(float x) {
  const int i = static_cast<int>(x);
  return i - (x < static_cast<float>(i));
}

/// A leaf of an occupancy grid, as rays read it. Refers to the map's memory.
struct VoxelLeaf {
  static constexpr int kNowhere = std::numeric_limits<int>::min();

  Cell cell{kNowhere, kNowhere, kNowhere};  ///< its place, in leaves
  const VdbCode* codes = nullptr;           ///< see vdb_voxel(); null where all voxels have `constant`
  VdbCode constant = kVdbUnknown;
  bool occupied = false;         ///< holds a voxel that is rather occupied than free
  int log2_empty = kVdbLeafLog2;  ///< where not: edge of an aligned cube around it that holds none, log2 of voxels
  std::uint32_t chunk = ChunkTable<VdbChunk>::kNone;

  VdbCode at(int x, int y, int z) const { return codes ? codes[vdb_voxel(x, y, z)] : constant; }
};

/// The leaves around a bundle of rays: found in the map once, read many times. Direct-mapped by the leaf's place, so that
/// neighbours never drive each other out. For one thread; the map must stay as it is.
class VoxelLeaves {
 public:
  explicit VoxelLeaves(const VdbMap& map) : map_(map), step_(map.step()) {}

  /// The leaf that holds a voxel. Valid until the next call.
  const VoxelLeaf& of(int x, int y, int z) {
    x >>= kVdbLeafLog2, y >>= kVdbLeafLog2, z >>= kVdbLeafLog2;
    constexpr int mask = (1 << kLog2Slots) - 1;
    auto& slot = slots_[static_cast<std::size_t>((x & mask) << 2 * kLog2Slots | (y & mask) << kLog2Slots | (z & mask))];
    if (slot.cell.z() != z || slot.cell.y() != y || slot.cell.x() != x) slot = find({x, y, z});
    return slot;
  }
  /// Log odds of a voxel; 0 where the map knows nothing.
  float log_odds(int x, int y, int z) { return step_ * known(of(x, y, z).at(x, y, z)); }
  /// Log odds between the centres of voxels, trilinear. p: in voxels; voxel (i, j, k) covers i .. i+1 and so on.
  float log_odds(const Eigen::Vector3f& p);

 private:
  static constexpr int kLog2Slots = 3;
  static float known(VdbCode code) { return code == kVdbUnknown ? 0.0f : static_cast<float>(code); }
  VoxelLeaf find(const Cell& leaf) const;

  const VdbMap& map_;
  float step_;
  std::array<VoxelLeaf, 1u << 3 * kLog2Slots> slots_{};
};

}  // namespace ppm
