#include "modules/maps/ppm/ppm_file.hpp"

#include <array>
#include <string>

#include "framework/core/error.hpp"
#include "framework/core/record_file.hpp"
#include "modules/maps/ppm/chunk_record.hpp"

// A file of records (see record_file.hpp). First record: version, settings, vertex ids, number of chunks. Then one record a
// chunk: cell, geometry, texels.

namespace ppm {
namespace {

constexpr std::string_view kMagic = "PPMMAP\r\n";
constexpr std::uint32_t kVersion = 3;

}  // namespace

/// Builds a map from records.
class PpmReader {
 public:
  explicit PpmReader(const std::filesystem::path& path) : records_(path, kMagic, "a map.ppm") {}

  std::shared_ptr<const PpmMap> read() {
    try {
      auto map = read_map();
      map->check();
      return map;
    } catch (const InternalError& error) {
      throw DataError(records_.file(), std::string("is not a sound map: ") + error.what());
    }
  }

 private:
  std::shared_ptr<PpmMap> read_map() {
    auto header = records_.next("the header");
    const auto version = header.take<std::uint32_t>();
    if (version != kVersion)
      header.fail(fmt::format("is of version {}; this program reads version {}", version, kVersion));
    auto map = std::make_shared<PpmMap>(header.take<PpmSettings>());
    map->next_vertex_id_ = header.take<std::uint32_t>();
    const auto chunks = header.take<std::uint64_t>();
    header.finish();
    for (std::uint64_t i = 0; i < chunks; ++i) read_chunk(*map, records_.next(fmt::format("chunk {}", i)));
    records_.finish("its last chunk");
    return map;
  }

  void read_chunk(PpmMap& map, RecordReader record) {
    const auto cell = record.take<std::array<std::int32_t, 3>>();
    auto geometry = record.take<Geometry>();
    auto texels = record.take<Texels>();
    record.finish();
    const Cell at(cell[0], cell[1], cell[2]);
    if (map.table_.find(at) != ChunkTable<PpmChunk>::kNone) record.fail("lies in a cell that has one already");
    if (!geometry.box.isEmpty())
      for (const auto& corner : {geometry.box.min(), geometry.box.max()})
        map.reach_ = std::max(map.reach_, (map.cell_of(corner) - at).cwiseAbs().maxCoeff());
    map.table_.add(at, {Cow<Geometry>::make(std::move(geometry)), Cow<Texels>::make(std::move(texels))});
  }

  RecordFileReader records_;
};

void save_ppm(const PpmMap& map, const std::filesystem::path& path) {
  RecordFileWriter file(path, kMagic);
  RecordWriter header;
  header.add(kVersion);
  header.add(map.settings());
  header.add(map.vertex_ids());
  header.add(static_cast<std::uint64_t>(map.table().size()));
  file.write(header);
  for (std::size_t i = 0; i < map.table().size(); ++i) {
    const Cell& cell = map.table().cell(i);
    RecordWriter chunk;
    chunk.add(std::array<std::int32_t, 3>{cell.x(), cell.y(), cell.z()});
    chunk.add(*map.table()[i].geometry);
    chunk.add(*map.table()[i].texels);
    file.write(chunk);
  }
  file.commit();
}

std::shared_ptr<const PpmMap> load_ppm(const std::filesystem::path& path) {
  return PpmReader(path).read();
}

}  // namespace ppm
