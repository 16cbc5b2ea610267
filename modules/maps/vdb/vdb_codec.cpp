#include "modules/maps/vdb/vdb_codec.hpp"

#include "framework/core/error.hpp"
#include "framework/slam/map_parts.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

// Records: how many tables, tiles and maps; each table of cells; each tile; each map, whose chunks are numbers of tiles or a
// constant.

namespace ppm {
namespace {

using Table = ChunkTable<VdbChunk>;
using Cells = std::vector<Cell>;

RecordWriter record_of(const VdbTile& tile) {
  RecordWriter out;
  out.add(tile.origin());
  for (int n = 0; n < kVdbTileLeaves; ++n) {
    const VdbCode* codes = tile.leaf(n);
    out.add(codes ? std::vector<VdbCode>(codes, codes + kVdbLeafVoxels) : std::vector<VdbCode>{tile.constant(n)});
  }
  return out;
}

Cow<VdbTile> take_tile(RecordReader& in) {
  auto tile = Cow<VdbTile>::make(in.take<Cell>(), kVdbUnknown);
  for (int n = 0; n < kVdbTileLeaves; ++n) {
    const auto codes = in.take<std::vector<VdbCode>>();
    if (codes.size() == 1) {
      tile.write().set_constant(n, codes[0]);
    } else if (codes.size() == kVdbLeafVoxels) {
      std::copy(codes.begin(), codes.end(), tile.write().write(n));
      tile.write().settle(n);
    } else {
      in.fail("has a leaf that is neither whole nor constant");
    }
  }
  in.finish();
  return tile;
}

}  // namespace

struct VdbCodec::Shared {
  std::vector<Table> tables;  ///< empty chunks: for their cells
  std::vector<Cow<VdbTile>> tiles;
};

void VdbCodec::save(const std::vector<const Map*>& maps, RecordFileWriter& file) const {
  MapParts<Cells> cells;
  MapParts<VdbTile> tiles;
  std::vector<RecordWriter> tables;
  for (const Map* map : maps) {
    const auto& grid = static_cast<const VdbMap&>(*map);
    auto& out = tables.emplace_back();
    out.add(grid.settings());
    out.add(grid.table().cells() ? cells.number(grid.table().cells()) : Table::kNone);
    out.add(static_cast<std::uint64_t>(grid.table().size()));
    for (const auto& chunk : grid.table().chunks()) {
      out.add(chunk.tile ? tiles.number(chunk.tile.get()) : Table::kNone);
      out.add(chunk.constant);
    }
  }
  save_counts({cells.all().size(), tiles.all().size(), maps.size()}, file);
  save_parts(cells.all(), file);
  for (const auto* tile : tiles.all()) file.write(record_of(*tile));
  for (const auto& table : tables) file.write(table);
}

std::vector<MapHandle> VdbCodec::load(RecordFileReader& file) const {
  auto counts = file.next("the numbers of grid parts");
  const auto n_cells = counts.take<std::uint64_t>(), n_tiles = counts.take<std::uint64_t>();
  const auto n_maps = counts.take<std::uint64_t>();
  counts.finish();
  Shared shared;
  shared.tables = load_tables<Table>(n_cells, file);
  for (std::uint64_t i = 0; i < n_tiles; ++i) {
    auto in = file.next(fmt::format("tile {}", i));
    shared.tiles.push_back(take_tile(in));
  }
  std::vector<MapHandle> maps;
  for (std::uint64_t i = 0; i < n_maps; ++i) {
    auto in = file.next(fmt::format("grid {}", i));
    maps.push_back(take_map(in, shared));
    in.finish();
  }
  return maps;
}

MapHandle VdbCodec::take_map(RecordReader& in, const Shared& shared) {
  const auto settings = in.take<VdbSettings>();
  if (!(settings.voxel_size_m > 0) || !(settings.log_odds_min < 0) || !(settings.log_odds_max > 0))
    in.fail("has settings that no grid can have");
  auto map = std::make_shared<VdbMap>(settings);
  const auto cells = in.take<std::uint32_t>();
  if (cells != Table::kNone) map->table_ = part_of(shared.tables, cells, in);
  std::vector<VdbChunk> chunks;
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    VdbChunk chunk;
    const auto number = in.take<std::uint32_t>();
    if (number != Table::kNone) chunk.tile = part_of(shared.tiles, number, in);
    in.take(chunk.constant);
    chunks.push_back(std::move(chunk));
  }
  if (chunks.size() != map->table_.size()) in.fail("has not a chunk for each cell");
  chunks.shrink_to_fit();
  map->table_.replace(std::move(chunks));
  return map;
}

}  // namespace ppm
