#include "modules/maps/ppm/ppm_codec.hpp"

#include "framework/core/error.hpp"
#include "framework/slam/map_parts.hpp"
#include "modules/maps/ppm/chunk_record.hpp"

// Records: how many parts of each sort; each table of cells; each geometry; each texture; each map, whose chunks are numbers of parts.

namespace ppm {
namespace {

using Table = ChunkTable<PpmChunk>;
using Cells = std::vector<Cell>;

template <class Part>
std::vector<Cow<Part>> load_parts(std::uint64_t count, const char* what, RecordFileReader& file) {
  std::vector<Cow<Part>> parts;
  for (std::uint64_t i = 0; i < count; ++i) {
    auto in = file.next(fmt::format("{} {}", what, i));
    parts.push_back(Cow<Part>::make(in.take<Part>()));
    in.finish();
  }
  return parts;
}

}  // namespace

void PpmCodec::save(const std::vector<const Map*>& maps, RecordFileWriter& file) const {
  MapParts<Cells> cells;
  MapParts<Geometry> geometries;
  MapParts<Texels> textures;
  std::vector<RecordWriter> tables;
  for (const Map* map : maps) {
    const auto& mesh = static_cast<const PpmMap&>(*map);
    auto& out = tables.emplace_back();
    out.add(mesh.settings());
    out.add(mesh.vertex_ids());
    out.add(mesh.reach());
    out.add(mesh.table().cells() ? cells.number(mesh.table().cells()) : Table::kNone);
    out.add(static_cast<std::uint64_t>(mesh.table().size()));
    for (const auto& chunk : mesh.table().chunks()) {
      out.add(geometries.number(chunk.geometry.get()));
      out.add(textures.number(chunk.texels.get()));
    }
  }
  save_counts({cells.all().size(), geometries.all().size(), textures.all().size(), maps.size()}, file);
  save_parts(cells.all(), file);
  save_parts(geometries.all(), file);
  save_parts(textures.all(), file);
  for (const auto& table : tables) file.write(table);
}

/// What maps refer to by number.
struct PpmCodec::Shared {
  std::vector<Table> tables;  ///< empty chunks: for their cells
  std::vector<Cow<Geometry>> geometries;
  std::vector<Cow<Texels>> textures;
};

std::vector<MapHandle> PpmCodec::load(RecordFileReader& file) const {
  auto counts = file.next("the numbers of mesh parts");
  const auto n_cells = counts.take<std::uint64_t>(), n_geometries = counts.take<std::uint64_t>();
  const auto n_textures = counts.take<std::uint64_t>(), n_maps = counts.take<std::uint64_t>();
  counts.finish();
  Shared shared;
  shared.tables = load_tables<Table>(n_cells, file);
  shared.geometries = load_parts<Geometry>(n_geometries, "geometry", file);
  shared.textures = load_parts<Texels>(n_textures, "texture", file);
  std::vector<MapHandle> maps;
  for (std::uint64_t i = 0; i < n_maps; ++i) {
    auto in = file.next(fmt::format("mesh {}", i));
    maps.push_back(take_map(in, shared));
    in.finish();
  }
  return maps;
}

MapHandle PpmCodec::take_map(RecordReader& in, const Shared& shared) {
  auto map = std::make_shared<PpmMap>(in.take<PpmSettings>());
  in.take(map->next_vertex_id_);
  in.take(map->reach_);
  const auto cells = in.take<std::uint32_t>();
  if (cells != Table::kNone) map->table_ = part_of(shared.tables, cells, in);
  std::vector<PpmChunk> chunks;
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    const auto& geometry = part_of(shared.geometries, in.take<std::uint32_t>(), in);
    chunks.push_back({geometry, part_of(shared.textures, in.take<std::uint32_t>(), in)});
  }
  if (chunks.size() != map->table_.size()) in.fail("has not a chunk for each cell");
  chunks.shrink_to_fit();
  map->table_.replace(std::move(chunks));
  return map;
}

}  // namespace ppm
