#include "modules/maps/vdb/vdb_map.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/vdb/vdb_mesh.hpp"

namespace ppm {

VdbMap::VdbMap(const VdbSettings& settings) : settings_(settings) {
  PPM_CHECK(settings.voxel_size_m > 0, "voxels of {} m", settings.voxel_size_m);
  PPM_CHECK(settings.log_odds_min < 0 && settings.log_odds_max > 0, "clamps {} .. {}", settings.log_odds_min,
            settings.log_odds_max);
  step_ = std::max(-settings.log_odds_min, settings.log_odds_max) / static_cast<float>(kVdbMost);
}

VdbCode VdbMap::code(float log_odds) const {
  const float clamped = std::clamp(log_odds, settings_.log_odds_min, settings_.log_odds_max);
  return static_cast<VdbCode>(std::lround(clamped / step_));
}

VdbCode VdbMap::value(const Cell& voxel) const {
  const auto number = table_.find(cell_of(voxel));
  if (number == ChunkTable<VdbChunk>::kNone) return kVdbUnknown;
  const VdbChunk& chunk = table_[number];
  return chunk.tile ? chunk.tile->value(voxel.x(), voxel.y(), voxel.z()) : chunk.constant;
}

std::optional<float> VdbMap::log_odds(const Cell& voxel) const {
  const VdbCode code = value(voxel);
  if (code == kVdbUnknown) return std::nullopt;
  return static_cast<float>(code) * step_;
}

MapStats VdbMap::stats() const {
  MapStats stats;
  for (const auto& chunk : table_.chunks()) {
    stats.chunks += chunk.tile || chunk.constant != kVdbUnknown;
    if (!chunk.tile) continue;
    for (int n = 0; n < kVdbTileLeaves; ++n)
      if (chunk.tile->leaf(n)) stats.texels += kVdbLeafVoxels;
  }
  std::unordered_set<const void*> none;
  stats.bytes = account(none);
  return stats;
}

std::int64_t VdbMap::account(std::unordered_set<const void*>& seen) const {
  if (!seen.insert(this).second) return 0;
  std::int64_t bytes = static_cast<std::int64_t>(sizeof *this) + table_.account(seen);
  for (const auto& chunk : table_.chunks())
    if (chunk.tile && seen.insert(chunk.tile.get()).second) bytes += chunk.tile->bytes();
  return bytes;
}

void VdbMap::digest(Digest& digest) const {
  digest.add(settings_.voxel_size_m);
  digest.add(settings_.log_odds_min);
  digest.add(settings_.log_odds_max);
  digest.add(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    digest.add(table_.cell(i).data(), 3 * sizeof(int));
    const VdbChunk& chunk = table_[i];
    digest.add(static_cast<bool>(chunk.tile));
    if (!chunk.tile) {
      digest.add(chunk.constant);
      continue;
    }
    for (int n = 0; n < kVdbTileLeaves; ++n) {
      const VdbCode* leaf = chunk.tile->leaf(n);
      digest.add(leaf != nullptr);
      if (leaf)
        digest.add(leaf, sizeof(VdbCode) * kVdbLeafVoxels);
      else
        digest.add(chunk.tile->constant(n));
    }
  }
}

Mesh VdbMap::mesh(Surface surface) const {
  return surface == Surface::base ? voxel_faces(*this) : zero_surface(*this);
}

}  // namespace ppm
