#include <catch2/catch.hpp>
#include <fstream>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "modules/maps/ppm/ppm_file.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using test::digest_of;

namespace {

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}
std::shared_ptr<const PpmMap> bumpy_map() {
  PpmSettings settings;
  settings.cell_size_m = 0.25;
  settings.texel_size_m = 0.06;
  auto map = test::height_field(5, 4, 0.1f, settings, [](float x, float y) { return 0.2f * x * x - 0.1f * y; });
  Rng rng(1, 0, 0, 0);
  PpmEdit edit(std::move(map));
  for (std::uint32_t c = 0; c < edit.map().table().size(); ++c) {
    auto& texels = edit.texels(c);
    for (auto& m : texels.mean) m = static_cast<float>(rng.normal() * 0.01);
    for (auto& v : texels.variance) v = static_cast<float>(1e-4 + 1e-3 * rng.uniform());
    for (auto& e : texels.evidence)
      e = {static_cast<std::uint16_t>(rng.below(1000)), static_cast<std::uint16_t>(rng.below(9)),
           static_cast<float>(rng.normal() * 1e-4)};
  }
  edit.remove_face(0, 1);
  return edit.commit();
}
std::string refusal(const std::filesystem::path& file) {
  try {
    load_ppm(file);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("colours come back from a file, and move with their faces") {
  test::TempFolder dir;
  PpmSettings settings;
  settings.color_channels = 3;
  PpmEdit edit(std::make_shared<const PpmMap>(settings));
  std::array<std::uint32_t, 4> id{};
  for (std::size_t k = 0; k < 4; ++k)
    id[k] = edit.add_vertex({static_cast<float>(k & 1) * 0.1f, static_cast<float>(k >> 1) * 0.1f, 0.5f});
  const std::vector<float> mean(3, 0.0f), variance(3, 1e-4f), color_variance{0.1f, 0.2f, 0.3f};
  auto shades = [](float base) {
    std::vector<float> c(9);
    for (std::size_t i = 0; i < 9; ++i) c[i] = base + 0.01f * static_cast<float>(i);
    return c;
  };
  const auto dark = shades(0.1f), light = shades(0.8f);
  edit.add_face({id[0], id[1], id[2]}, 1, {mean, variance, dark, color_variance});
  edit.add_face({id[1], id[3], id[2]}, 1, {mean, variance, light, color_variance});
  CHECK_THROWS_AS(edit.add_face({id[1], id[3], id[2]}, 1, {mean, variance}), InternalError);
  auto map = edit.commit();
  map->check();
  save_ppm(*map, dir / "map.ppm");
  const auto back = load_ppm(dir / "map.ppm");
  CHECK(digest_of(*back) == digest_of(*map));
  PpmEdit removal(back);
  removal.remove_face(0, 0);
  const auto rest = removal.commit();
  rest->check();
  const Texels& texels = *rest->table()[0].texels;
  CHECK(texels.color == light);
  CHECK(texels.color_variance == color_variance);
}

TEST_CASE("a map comes back from its file exactly, and can be edited on") {
  test::TempFolder dir;
  const auto map = bumpy_map();
  save_ppm(*map, dir / "map.ppm");
  const auto back = load_ppm(dir / "map.ppm");
  CHECK(digest_of(*back) == digest_of(*map));
  CHECK(back->stats().vertices == map->stats().vertices);
  CHECK(back->vertex_ids() == map->vertex_ids());
  for (std::size_t c = 0; c < map->table().size(); ++c)
    CHECK(back->table()[c].geometry->open_edge == map->table()[c].geometry->open_edge);
  auto edited = [](std::shared_ptr<const PpmMap> m) {
    PpmEdit edit(m);
    edit.remove_face(1, 0);
    edit.move_vertex(2, 0, m->table()[2].geometry->position[0] + Eigen::Vector3f(0, 0, 0.01f));
    return edit.commit();
  };
  CHECK(digest_of(*edited(back)) == digest_of(*edited(map)));
}

TEST_CASE("an empty map can be saved") {
  test::TempFolder dir;
  const PpmMap map{PpmSettings{}};
  save_ppm(map, dir / "map.ppm");
  CHECK(digest_of(*load_ppm(dir / "map.ppm")) == digest_of(map));
}

TEST_CASE("a file that is cut short anywhere is refused") {
  test::TempFolder dir;
  save_ppm(*bumpy_map(), dir / "map.ppm");
  const auto bytes = read_bytes(dir / "map.ppm");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    write_bytes(dir / "cut.ppm", bytes.substr(0, length));
    const auto reason = refusal(dir / "cut.ppm");
    INFO("length " << length);
    REQUIRE(reason.find("cut short") != std::string::npos);
    REQUIRE(reason.find("cut.ppm") != std::string::npos);
  }
}

TEST_CASE("a file that was altered anywhere is refused") {
  test::TempFolder dir;
  save_ppm(*bumpy_map(), dir / "map.ppm");
  const auto bytes = read_bytes(dir / "map.ppm");
  Rng rng(3, 0, 0, 0);
  for (int trial = 0; trial < 3000; ++trial) {
    auto altered = bytes;
    const auto at = rng.below(static_cast<std::uint32_t>(bytes.size()));
    altered[at] = static_cast<char>(altered[at] ^ (1 << rng.below(8)));
    write_bytes(dir / "altered.ppm", altered);
    INFO("byte " << at);
    REQUIRE(!refusal(dir / "altered.ppm").empty());
  }
  write_bytes(dir / "longer.ppm", bytes + "x");
  CHECK(refusal(dir / "longer.ppm").find("goes on") != std::string::npos);
}

TEST_CASE("files that are not maps, of another version, or not there are refused with the reason") {
  test::TempFolder dir;
  CHECK(refusal(dir / "none.ppm").find("cannot be opened") != std::string::npos);
  write_bytes(dir / "text.ppm", "P6\n640 480\n255\n");
  CHECK(refusal(dir / "text.ppm").find("is not a map.ppm") != std::string::npos);

  save_ppm(*bumpy_map(), dir / "map.ppm");
  auto bytes = read_bytes(dir / "map.ppm");
  const std::size_t start = 16;  // after magic and length
  std::uint64_t length = 0;
  std::copy_n(bytes.data() + 8, sizeof length, reinterpret_cast<char*>(&length));
  bytes[start] = 9;  // the version
  Digest digest;
  digest.add(bytes.data() + start, length);
  bytes.replace(start + length, 32, digest.hex());
  write_bytes(dir / "newer.ppm", bytes);
  CHECK(refusal(dir / "newer.ppm").find("version 9") != std::string::npos);
}

TEST_CASE("nothing is left where a map cannot be written") {
  test::TempFolder dir;
  CHECK_THROWS_AS(save_ppm(*bumpy_map(), dir / "no_such_folder/map.ppm"), OutputError);
  CHECK(std::filesystem::is_empty(dir.path()));
}
