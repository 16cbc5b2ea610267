#include "modules/maps/octomap/octomap_codec.hpp"

#include <fmt/format.h>

#include "modules/maps/octomap/octomap_map.hpp"

// Records: the number of maps; each map.

namespace ppm {

void OctomapCodec::save(const std::vector<const Map*>& maps, RecordFileWriter& file) const {
  RecordWriter count;
  count.add(static_cast<std::uint64_t>(maps.size()));
  file.write(count);
  for (const Map* map : maps) {
    RecordWriter out;
    ppm::save(out, static_cast<const OctomapMap&>(*map));
    file.write(out);
  }
}

std::vector<MapHandle> OctomapCodec::load(RecordFileReader& file) const {
  auto count = file.next("the number of octrees");
  const auto maps = count.take<std::uint64_t>();
  count.finish();
  std::vector<MapHandle> loaded;
  for (std::uint64_t i = 0; i < maps; ++i) {
    auto in = file.next(fmt::format("octree {}", i));
    loaded.push_back(load_octomap(in));
    in.finish();
  }
  return loaded;
}

}  // namespace ppm
