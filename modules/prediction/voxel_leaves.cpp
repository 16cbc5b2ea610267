#include "modules/prediction/voxel_leaves.hpp"

namespace ppm {

VoxelLeaf VoxelLeaves::find(const Cell& leaf) const {
  VoxelLeaf out;
  out.cell = leaf;
  const Cell voxel = leaf * kVdbLeafEdge;
  out.chunk = map_.table().find(VdbMap::cell_of(voxel));
  if (out.chunk != ChunkTable<VdbChunk>::kNone) {
    const VdbChunk& chunk = map_.table()[out.chunk];
    if (chunk.tile) {
      const int n = vdb_leaf(voxel.x(), voxel.y(), voxel.z());
      out.codes = chunk.tile->leaf(n);
      out.constant = chunk.tile->constant(n);
      out.occupied = chunk.tile->occupied(n);
      return out;
    }
    out.constant = chunk.constant;
  }
  out.occupied = out.constant > 0;
  out.log2_empty = kVdbLeafLog2 + kVdbTileLog2;
  return out;
}

float VoxelLeaves::log_odds(const Eigen::Vector3f& p) {
  const float x = p.x() - 0.5f, y = p.y() - 0.5f, z = p.z() - 0.5f;
  const int i = floor_of(x), j = floor_of(y), k = floor_of(z);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j), w = z - static_cast<float>(k);
  std::array<float, 8> c;
  constexpr int last = kVdbLeafEdge - 1;
  if ((i & last) != last && (j & last) != last && (k & last) != last) {
    const VoxelLeaf& leaf = of(i, j, k);
    if (!leaf.codes) return step_ * known(leaf.constant);
    const VdbCode* at = leaf.codes + vdb_voxel(i, j, k);
    constexpr std::array<int, 8> apart{0, 1, 8, 9, 64, 65, 72, 73};
    for (std::size_t n = 0; n < 8; ++n) c[n] = known(at[apart[n]]);
  } else {
    for (int n = 0; n < 8; ++n) {
      const int cx = i + (n >> 2), cy = j + (n >> 1 & 1), cz = k + (n & 1);
      c[static_cast<std::size_t>(n)] = known(of(cx, cy, cz).at(cx, cy, cz));
    }
  }
  auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  return step_ * mix(mix(mix(c[0], c[1], w), mix(c[2], c[3], w), v), mix(mix(c[4], c[5], w), mix(c[6], c[7], w), v), u);
}

}  // namespace ppm
