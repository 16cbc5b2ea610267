#pragma once
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// Values of voxels near each other: remembers the chunk of the last one. Refers to the map; one a thread.
class VdbReader {
 public:
  explicit VdbReader(const VdbMap& map) : map_(map) {}

  /// A leaf: its voxels (see vdb_voxel), or null and what all of them are.
  struct Leaf {
    const VdbCode* codes = nullptr;
    VdbCode constant = kVdbUnknown;
    VdbCode operator[](int voxel) const { return codes ? codes[voxel] : constant; }
  };
  /// The leaf that holds a voxel.
  Leaf leaf(int x, int y, int z) {
    const VdbChunk* chunk = chunk_of(x, y, z);
    if (!chunk) return {};
    if (!chunk->tile) return {nullptr, chunk->constant};
    const int n = vdb_leaf(x, y, z);
    return {chunk->tile->leaf(n), chunk->tile->constant(n)};
  }
  VdbCode operator()(int x, int y, int z) { return leaf(x, y, z)[vdb_voxel(x, y, z)]; }

 private:
  const VdbChunk* chunk_of(int x, int y, int z) {
    const Cell cell = VdbMap::cell_of({x, y, z});
    if (!known_ || cell != cell_) {
      cell_ = cell;
      number_ = map_.table().find(cell);
      known_ = true;
    }
    return number_ == ChunkTable<VdbChunk>::kNone ? nullptr : &map_.table()[number_];
  }
  const VdbMap& map_;
  Cell cell_ = Cell::Zero();
  std::uint32_t number_ = 0;
  bool known_ = false;
};

}  // namespace ppm
