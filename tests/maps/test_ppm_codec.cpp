#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "framework/slam/map_memory.hpp"
#include "modules/maps/ppm/ppm_codec.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using test::digest_of;

namespace {

constexpr std::string_view kMagic = "PPMTEST\n";

std::vector<MapHandle> there_and_back(const std::vector<MapHandle>& maps) {
  test::TempFolder folder;
  std::vector<const Map*> plain;
  for (const auto& map : maps) plain.push_back(map.get());
  RecordFileWriter out(folder / "maps", kMagic);
  PpmCodec().save(plain, out);
  out.commit();
  RecordFileReader in(folder / "maps", kMagic, "maps");
  auto back = PpmCodec().load(in);
  in.finish("the maps");
  return back;
}

/// Three maps of one family: a parent, a child with other texels in one chunk, a child with a face more in a new chunk.
std::vector<MapHandle> family() {
  PpmSettings settings;
  settings.cell_size_m = 0.25;
  const auto parent = test::height_field(5, 4, 0.1f, settings, [](float x, float y) { return 0.2f * x * x - 0.1f * y; });
  PpmEdit texels(parent);
  texels.texels(1).mean[3] = 0.01f;
  PpmEdit faces(parent);
  const auto a = faces.add_vertex({2, 2, 0}), b = faces.add_vertex({2.1f, 2, 0}), c = faces.add_vertex({2, 2.1f, 0});
  test::add_flat_face(faces, {a, b, c}, 2, 0, 1e-3f, {3, 1, 1e-4f});
  return {parent, texels.commit(), faces.commit()};
}

std::int64_t memory_of(const std::vector<MapHandle>& maps) {
  std::unordered_set<const void*> seen;
  std::int64_t bytes = 0;
  for (const auto& map : maps) bytes += map->account(seen);
  return bytes;
}

const PpmMap& mesh(const MapHandle& map) {
  return static_cast<const PpmMap&>(*map);
}

}  // namespace

TEST_CASE("mesh maps come back from a checkpoint with their content and what they share") {
  const auto maps = family();
  const auto back = there_and_back(maps);
  REQUIRE(back.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(digest_of(*back[i]) == digest_of(*maps[i]));
    CHECK(mesh(back[i]).reach() == mesh(maps[i]).reach());
    CHECK_NOTHROW(mesh(back[i]).check());
  }
  CHECK(memory_of(back) == memory_of(maps));
  CHECK(mesh(back[0]).table().cells() == mesh(back[1]).table().cells());
  CHECK(mesh(back[0]).table().cells() != mesh(back[2]).table().cells());
  for (std::size_t c = 0; c < mesh(maps[0]).table().size(); ++c)
    for (std::size_t i = 1; i < 3; ++i) {
      const auto &was = mesh(maps[i]).table()[c], &was_parent = mesh(maps[0]).table()[c];
      const auto &is = mesh(back[i]).table()[c], &is_parent = mesh(back[0]).table()[c];
      CHECK((is.geometry == is_parent.geometry) == (was.geometry == was_parent.geometry));
      CHECK((is.texels == is_parent.texels) == (was.texels == was_parent.texels));
    }
}

TEST_CASE("a map from a checkpoint is edited on like the one that was saved, and its siblings stay") {
  const auto maps = family();
  auto back = there_and_back(maps);
  auto edited = [](MapHandle map) {
    PpmEdit edit(std::static_pointer_cast<const PpmMap>(std::move(map)));
    edit.remove_face(1, 0);
    edit.texels(0).mean[0] = 1;
    return edit.commit();
  };
  CHECK(digest_of(*edited(back[0])) == digest_of(*edited(maps[0])));
  CHECK(digest_of(*back[1]) == digest_of(*maps[1]));
}

TEST_CASE("an empty mesh comes back") {
  const MapHandle empty = std::make_shared<const PpmMap>(PpmSettings{});
  CHECK(digest_of(*there_and_back({empty})[0]) == digest_of(*empty));
}

TEST_CASE("what a chunk occupies depends on its content alone") {
  const auto map = test::height_field(6, 6, 0.1f);
  PpmEdit edit(map);
  for (std::uint32_t f = 0; f < 20; ++f) edit.remove_face(0, f);
  const auto cloned = edit.commit();
  const auto copy = there_and_back({cloned});  // every array of a fresh copy is exact
  CHECK(cloned->stats().bytes == copy[0]->stats().bytes);
}
