#include "modules/maps/vdb/vdb_edit.hpp"

#include "framework/core/only_handle.hpp"

namespace ppm {

VdbEdit::VdbEdit(std::shared_ptr<const VdbMap> map)
    : map_(is_only_handle(map) ? std::const_pointer_cast<VdbMap>(std::move(map)) : std::make_shared<VdbMap>(*map)) {}

std::uint32_t VdbEdit::chunk(const Cell& cell) {
  const auto number = map_->table_.find(cell);
  return number != ChunkTable<VdbChunk>::kNone ? number : map_->table_.add(cell, {});
}

VdbTile& VdbEdit::tile(std::uint32_t chunk) {
  VdbChunk& c = map_->table_.edit(chunk);
  if (!c.tile) c.tile = Cow<VdbTile>::make(map_->table_.cell(chunk) * kVdbTileEdge, c.constant);
  return c.tile.write();
}

void VdbEdit::set_constant(std::uint32_t chunk, VdbCode value) {
  map_->table_.edit(chunk) = {{}, value};
}

void VdbEdit::settle(std::uint32_t chunk) {
  const VdbChunk& c = map_->table_[chunk];
  if (c.tile && c.tile->uniform()) set_constant(chunk, c.tile->constant(0));
}

std::shared_ptr<const VdbMap> VdbEdit::commit() {
  map_->table_.shrink_to_fit();
  return std::move(map_);
}

}  // namespace ppm
