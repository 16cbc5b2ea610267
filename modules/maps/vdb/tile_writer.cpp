#include "modules/maps/vdb/tile_writer.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {

TileWriter::TileWriter(VdbEdit& edit, float keep)
    : edit_(edit),
      how_{keep, static_cast<float>(edit.map().code(edit.map().settings().log_odds_min)),
           static_cast<float>(edit.map().code(edit.map().settings().log_odds_max))} {}

Cell TileWriter::origin(std::uint32_t chunk, int leaf) const {
  return edit_.map().table().cell(chunk) * kVdbTileEdge + VdbTile::offset(leaf);
}

bool TileWriter::read(std::uint32_t number, int leaf, LeafCodes& codes) const {
  const VdbChunk& from = chunk(number);
  const VdbCode* voxels = from.tile ? from.tile->leaf(leaf) : nullptr;
  if (voxels)
    std::copy(voxels, voxels + kVdbLeafVoxels, codes.begin());
  else
    codes.fill(from.tile ? from.tile->constant(leaf) : from.constant);
  return !voxels;
}

void TileWriter::write(std::uint32_t number, int leaf, const LeafCodes& before, const LeafCodes& after) const {
  if (after == before) return;
  VdbTile& tile = edit_.tile(number);
  std::copy(after.begin(), after.end(), tile.write(leaf));
  tile.settle(leaf);
}

void TileWriter::add(std::uint32_t number, int leaf, float evidence) const {
  LeafCodes before;
  if (read(number, leaf, before)) {
    const VdbCode constant = sum(before[0], evidence);
    if (constant != before[0]) edit_.tile(number).set_constant(leaf, constant);
    return;
  }
  LeafCodes after = before;
  add_to_leaf(how_, evidence, after.data());
  write(number, leaf, before, after);
}

void TileWriter::add(std::uint32_t number, float evidence) const {
  const VdbCode before = chunk(number).constant, after = sum(before, evidence);
  if (after != before) edit_.set_constant(number, after);
}

VdbCode TileWriter::sum(VdbCode code, float evidence) const {
  const float before = code == kVdbUnknown ? 0.f : code;
  return static_cast<VdbCode>(std::lrintf(std::clamp(how_.keep * before + evidence, how_.least, how_.most)));
}

}  // namespace ppm
