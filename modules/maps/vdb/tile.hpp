#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "framework/core/cow.hpp"
#include "framework/slam/chunk_table.hpp"

namespace ppm {

/// A voxel's log-odds of being occupied, in steps of VdbMap::step(). Negative: more likely free.
using VdbCode = std::int16_t;
/// What was never observed. Such voxels are inactive in OpenVDB's masks.
constexpr VdbCode kVdbUnknown = std::numeric_limits<VdbCode>::min();
constexpr VdbCode kVdbMost = std::numeric_limits<VdbCode>::max();

constexpr int kVdbLeafLog2 = 3, kVdbLeafEdge = 1 << kVdbLeafLog2;  ///< voxels along a leaf's edge
constexpr int kVdbLeafVoxels = kVdbLeafEdge * kVdbLeafEdge * kVdbLeafEdge;
constexpr int kVdbTileLog2 = 1, kVdbTileEdge = kVdbLeafEdge << kVdbTileLog2;  ///< voxels along a tile's edge
constexpr int kVdbTileLeaves = 1 << (3 * kVdbTileLog2);

/// A voxel's place in its leaf; x, y, z are the voxel's coordinates, or those within its leaf or tile. OpenVDB's order:
/// z runs fastest.
constexpr int vdb_voxel(int x, int y, int z) {
  constexpr int m = kVdbLeafEdge - 1;
  return ((x & m) << (2 * kVdbLeafLog2)) | ((y & m) << kVdbLeafLog2) | (z & m);
}
/// A leaf's place in its tile, for coordinates as above. z runs fastest.
constexpr int vdb_leaf(int x, int y, int z) {
  constexpr int m = (1 << kVdbTileLog2) - 1;
  return (((x >> kVdbLeafLog2) & m) << (2 * kVdbTileLog2)) | (((y >> kVdbLeafLog2) & m) << kVdbTileLog2) |
         ((z >> kVdbLeafLog2) & m);
}

/// A cube of kVdbTileEdge^3 voxels: one OpenVDB internal node over leaf nodes of 8^3 voxels. A leaf whose voxels are all
/// alike is a constant and has no node (OpenVDB's tile values). Copying clones all leaves.
class VdbTile {
 public:
  /// Every voxel has this value. origin: the tile's lowest voxel.
  VdbTile(const Cell& origin, VdbCode value);
  VdbTile(const VdbTile& other);
  VdbTile& operator=(const VdbTile&) = delete;
  ~VdbTile();

  Cell origin() const;
  /// Where a leaf begins in its tile, voxels.
  static Cell offset(int leaf) {
    constexpr int m = (1 << kVdbTileLog2) - 1;
    return kVdbLeafEdge * Cell((leaf >> (2 * kVdbTileLog2)) & m, (leaf >> kVdbTileLog2) & m, leaf & m);
  }
  /// The voxels of a leaf (see vdb_voxel), or null where all are constant(leaf).
  const VdbCode* leaf(int leaf) const { return codes_[static_cast<std::size_t>(leaf)]; }
  VdbCode constant(int leaf) const { return constant_[static_cast<std::size_t>(leaf)]; }
  /// Coordinates of a voxel, or those within the tile.
  VdbCode value(int x, int y, int z) const {
    const int n = vdb_leaf(x, y, z);
    return leaf(n) ? leaf(n)[vdb_voxel(x, y, z)] : constant(n);
  }

  /// Whether a leaf holds a voxel that is rather occupied than free.
  bool occupied(int leaf) const { return occupied_[static_cast<std::size_t>(leaf)]; }

  /// The voxels of a leaf for writing, made out of the constant where there were none. After writing: settle().
  VdbCode* write(int leaf);
  /// Makes a leaf constant.
  void set_constant(int leaf, VdbCode value);
  /// Brings masks and occupied() up to date, and makes the leaf a constant where all its voxels are alike.
  void settle(int leaf);
  /// Whether all leaves are the same constant.
  bool uniform() const;
  /// All memory of this tile, with what the allocator adds.
  std::int64_t bytes() const;

 private:
  struct Node;
  std::unique_ptr<Node> node_;
  std::array<VdbCode*, kVdbTileLeaves> codes_{};  // of the node's leaves, for those who walk through them
  std::array<VdbCode, kVdbTileLeaves> constant_{};
  std::array<bool, kVdbTileLeaves> occupied_{};
};

/// A chunk of the map: a tile, or one value for the whole of it.
struct VdbChunk {
  Cow<VdbTile> tile;            ///< empty where all voxels are `constant`
  VdbCode constant = kVdbUnknown;
};

}  // namespace ppm
