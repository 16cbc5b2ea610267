#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace open3d::pipelines::integration {
class UniformTSDFVolume;
}

namespace ppm {

/// A cube of voxels with signed distances, as Open3D keeps them.
using TsdfBlock = open3d::pipelines::integration::UniformTSDFVolume;

/// Finds blocks by their place in the lattice of blocks. Does not own them. Linear probing, at most half full: a ray asks
/// for many blocks that are not there.
class TsdfBlocks {
 public:
  using Entry = std::pair<Eigen::Vector3i, const TsdfBlock*>;

  TsdfBlocks() = default;
  explicit TsdfBlocks(const std::vector<Entry>& blocks);
  /// Null where there is none.
  const TsdfBlock* find(const Eigen::Vector3i& place) const;
  std::int64_t bytes() const { return static_cast<std::int64_t>(slots_.capacity() * sizeof(Entry)); }

 private:
  std::size_t slot_of(const Eigen::Vector3i& place) const;
  std::vector<Entry> slots_;  // a power of two
};

}  // namespace ppm
