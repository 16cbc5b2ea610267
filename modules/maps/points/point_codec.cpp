#include "modules/maps/points/point_codec.hpp"

#include "framework/core/error.hpp"
#include "framework/slam/map_parts.hpp"
#include "modules/maps/points/point_map.hpp"

// Records: how many tables, tiles and maps; each table of cells; each tile; each map, whose chunks are numbers of tiles.

namespace ppm {
namespace {

using Table = ChunkTable<PointChunk>;
using Cells = std::vector<Cell>;

Cow<PointTile> take_tile(RecordReader& in) {
  auto tile = Cow<PointTile>::make();
  auto& content = tile.write();
  in.take(content.points);
  if (!std::ranges::is_sorted(content.points, {}, &SurfacePoint::voxel)) in.fail("has points out of order");
  content.seal();
  in.finish();
  return tile;
}

}  // namespace

struct PointCodec::Shared {
  std::vector<Table> tables;  ///< empty chunks: for their cells
  std::vector<Cow<PointTile>> tiles;
};

void PointCodec::save(const std::vector<const Map*>& maps, RecordFileWriter& file) const {
  MapParts<Cells> cells;
  MapParts<PointTile> tiles;
  std::vector<RecordWriter> tables;
  for (const Map* map : maps) {
    const auto& points = static_cast<const PointMap&>(*map);
    auto& out = tables.emplace_back();
    out.add(points.spacing_m());
    out.add(points.table().cells() ? cells.number(points.table().cells()) : Table::kNone);
    std::vector<std::uint32_t> numbers;
    for (const auto& chunk : points.table().chunks()) numbers.push_back(tiles.number(chunk.tile.get()));
    out.add(numbers);
  }
  save_counts({cells.all().size(), tiles.all().size(), maps.size()}, file);
  save_parts(cells.all(), file);
  for (const auto* tile : tiles.all()) {
    RecordWriter out;
    out.add(tile->points);
    file.write(out);
  }
  for (const auto& table : tables) file.write(table);
}

std::vector<MapHandle> PointCodec::load(RecordFileReader& file) const {
  auto counts = file.next("the numbers of parts of point maps");
  const auto n_cells = counts.take<std::uint64_t>(), n_tiles = counts.take<std::uint64_t>();
  const auto n_maps = counts.take<std::uint64_t>();
  counts.finish();
  Shared shared;
  shared.tables = load_tables<Table>(n_cells, file);
  for (std::uint64_t i = 0; i < n_tiles; ++i) {
    auto in = file.next(fmt::format("tile of points {}", i));
    shared.tiles.push_back(take_tile(in));
  }
  std::vector<MapHandle> maps;
  for (std::uint64_t i = 0; i < n_maps; ++i) {
    auto in = file.next(fmt::format("point map {}", i));
    maps.push_back(take_map(in, shared));
    in.finish();
  }
  return maps;
}

MapHandle PointCodec::take_map(RecordReader& in, const Shared& shared) {
  const auto spacing = in.take<double>();
  if (!(spacing > 0)) in.fail("has a spacing that no point map can have");
  auto map = std::make_shared<PointMap>(spacing);
  const auto cells = in.take<std::uint32_t>();
  if (cells != Table::kNone) map->table_ = part_of(shared.tables, cells, in);
  std::vector<PointChunk> chunks;
  for (const auto number : in.take<std::vector<std::uint32_t>>()) chunks.push_back({part_of(shared.tiles, number, in)});
  if (chunks.size() != map->table_.size()) in.fail("has not a tile for each cell");
  chunks.shrink_to_fit();
  map->table_.replace(std::move(chunks));
  return map;
}

}  // namespace ppm
