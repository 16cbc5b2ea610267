// Maps that share tiles: what is written in one is not seen in another, and memory is counted once.
#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/maps/vdb/vdb_codec.hpp"
#include "tests/occupancy/occupancy_world.hpp"
#include "tests/support/temp_folder.hpp"

#include <filesystem>

using namespace ppm;
using test::VdbPtr;
using test::digest_of;

namespace {

constexpr std::string_view kMagic = "VDBTEST\n";

std::int64_t memory_of(const std::vector<VdbPtr>& maps) {
  std::unordered_set<const void*> seen;
  std::int64_t bytes = 0;
  for (const auto& map : maps) bytes += map->account(seen);
  return bytes;
}

/// A parent, a child that saw one view more, and an empty grid.
std::vector<VdbPtr> family() {
  const auto parent = test::box_map(test::empty_grid(0.05), 0, 4);
  return {parent, test::box_map(parent, 4, 5), test::empty_grid(0.1)};
}

void save(const std::vector<VdbPtr>& maps, const std::filesystem::path& file) {
  std::vector<const Map*> plain;
  for (const auto& map : maps) plain.push_back(map.get());
  RecordFileWriter out(file, kMagic);
  VdbCodec().save(plain, out);
  out.commit();
}

std::vector<VdbPtr> load(const std::filesystem::path& file) {
  RecordFileReader in(file, kMagic, "maps");
  std::vector<VdbPtr> maps;
  for (auto& map : VdbCodec().load(in)) maps.push_back(std::static_pointer_cast<const VdbMap>(map));
  in.finish("the maps");
  return maps;
}

}  // namespace

TEST_CASE("editing a child never changes its parent, whatever the order of edits") {
  std::vector<VdbPtr> maps{test::box_map(test::empty_grid(0.05), 0, 2)};
  std::vector<std::string> digests{digest_of(*maps[0])};
  for (int i = 0; i < 24; ++i) {
    const auto& parent = maps[static_cast<std::size_t>(i * 7 % static_cast<int>(maps.size()))];
    maps.push_back(test::box_map(parent, i, i + 1));
    digests.push_back(digest_of(*maps.back()));
  }
  for (std::size_t i = 0; i < maps.size(); ++i) CHECK(digest_of(*maps[i]) == digests[i]);
}

TEST_CASE("a child shares the tiles that it did not write") {
  const auto maps = family();
  std::size_t shared = 0, own = 0;
  for (std::size_t i = 0; i < maps[0]->table().size(); ++i) {
    if (!maps[0]->table()[i].tile) continue;
    ++(maps[0]->table()[i].tile == maps[1]->table()[i].tile ? shared : own);
  }
  CHECK(shared > 10);
  CHECK(own > 3);
  CHECK(memory_of({maps[0], maps[1]}) < memory_of({maps[0]}) + memory_of({maps[1]}));
  CHECK(memory_of({maps[0], maps[0]}) == maps[0]->stats().bytes);
}

TEST_CASE("a map with one handle is edited in place") {
  auto map = test::box_map(test::empty_grid(0.05), 0, 2);
  const auto* before = map.get();
  map = test::box_map(std::move(map), 2, 3);
  CHECK(map.get() == before);
}

TEST_CASE("grids come back from a checkpoint with their content and what they share") {
  test::TempFolder folder;
  const auto maps = family();
  save(maps, folder / "maps");
  const auto back = load(folder / "maps");
  REQUIRE(back.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(digest_of(*back[i]) == digest_of(*maps[i]));
  CHECK(memory_of(back) == memory_of(maps));
  for (std::size_t i = 0; i < maps[0]->table().size(); ++i)
    CHECK((back[0]->table()[i].tile == back[1]->table()[i].tile) == (maps[0]->table()[i].tile == maps[1]->table()[i].tile));
  CHECK(digest_of(*test::box_map(back[0], 6, 8)) == digest_of(*test::box_map(maps[0], 6, 8)));
}

TEST_CASE("a checkpoint of grids that is cut short is refused") {
  test::TempFolder folder;
  save(family(), folder / "maps");
  const auto whole = std::filesystem::file_size(folder / "maps");
  for (auto size : {whole - 1, whole / 2, whole / 10}) {
    std::filesystem::resize_file(folder / "maps", size);
    CHECK_THROWS_AS(load(folder / "maps"), DataError);
  }
}
