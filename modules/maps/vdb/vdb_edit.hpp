#pragma once
#include <memory>

#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// The one way to change a map: takes a handle, and commit() freezes the result as a new map that shares every tile that
/// was not written. Where the handle was the only one its memory is reused. One session a map; tile() and settle() may be
/// called from several threads for different chunks, all else from one.
class VdbEdit {
 public:
  explicit VdbEdit(std::shared_ptr<const VdbMap> map);

  /// The map with what was written so far.
  const VdbMap& map() const { return *map_; }
  /// The chunk of a cell, added (unknown) where there is none.
  std::uint32_t chunk(const Cell& cell);
  /// A chunk's tile for writing, cloned where another map shares it. Good until settle().
  VdbTile& tile(std::uint32_t chunk);
  /// Makes a whole chunk constant.
  void set_constant(std::uint32_t chunk, VdbCode value);
  /// Ends the writing to a chunk: one that has become uniform keeps its value alone. Its leaves are settled by those who
  /// wrote them.
  void settle(std::uint32_t chunk);
  std::shared_ptr<const VdbMap> commit();

 private:
  std::shared_ptr<VdbMap> map_;
};

}  // namespace ppm
