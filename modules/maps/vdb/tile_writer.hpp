#pragma once
#include <array>

#include "modules/maps/vdb/leaf_look.hpp"
#include "modules/maps/vdb/vdb_edit.hpp"

namespace ppm {

/// The voxels of a leaf, in the order of vdb_voxel().
using LeafCodes = std::array<VdbCode, kVdbLeafVoxels>;

/// Adds evidence to the tiles of an edit session. What does not change is not written, so that it stays shared.
/// Different chunks may be written by several threads at once.
class TileWriter {
 public:
  /// keep: share of a voxel's log-odds that stays when evidence is added to it.
  TileWriter(VdbEdit& edit, float keep);

  /// The lowest voxel of a leaf.
  Cell origin(std::uint32_t chunk, int leaf) const;
  /// What a leaf holds. True where that is a constant.
  bool read(std::uint32_t chunk, int leaf, LeafCodes& codes) const;
  /// Makes `after` of a leaf that holds `before`.
  void write(std::uint32_t chunk, int leaf, const LeafCodes& before, const LeafCodes& after) const;
  /// Adds the same evidence to every voxel of a leaf.
  void add(std::uint32_t chunk, int leaf, float evidence) const;
  /// Adds the same evidence to every voxel of a chunk that is a constant.
  void add(std::uint32_t chunk, float evidence) const;
  /// A voxel's code after evidence, within the clamps. evidence: in codes.
  VdbCode sum(VdbCode code, float evidence) const;
  /// How evidence is added.
  const LeafSum& how() const { return how_; }
  /// Ends the writing to a chunk.
  void settle(std::uint32_t chunk) const { edit_.settle(chunk); }
  const VdbChunk& chunk(std::uint32_t number) const { return edit_.map().table()[number]; }

 private:
  VdbEdit& edit_;
  LeafSum how_;
};

}  // namespace ppm
