#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>

#include "framework/graph/harness.hpp"
#include "modules/maps/ppm/ppm_file.hpp"
#include "modules/sinks/output_name.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

/// What a program that knows only the PLY format gets out of a file.
struct PlyFile {
  std::vector<std::string> header, properties;
  std::vector<std::vector<float>> vertex;
  std::vector<std::vector<std::int32_t>> face;
  bool all_read = false;
};

PlyFile read_ply(const std::filesystem::path& file) {
  PlyFile ply;
  std::ifstream in(file, std::ios::binary);
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    ply.header.push_back(line);
    std::istringstream words(line);
    std::string a, b, c;
    words >> a >> b >> c;
    if (a == "element" && b == "vertex") vertices = std::stoul(c);
    if (a == "element" && b == "face") faces = std::stoul(c);
    if (a == "property" && b == "float") ply.properties.push_back(c);
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    std::vector<float> values(ply.properties.size());
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
    ply.vertex.push_back(values);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    std::vector<std::int32_t> corners(static_cast<std::size_t>(in.get()));
    in.read(reinterpret_cast<char*>(corners.data()),
            static_cast<std::streamsize>(corners.size() * sizeof(std::int32_t)));
    ply.face.push_back(corners);
  }
  ply.all_read = in.good() && in.get() == std::char_traits<char>::eof();
  return ply;
}

std::shared_ptr<const PpmMap> offset_map() {
  PpmEdit edit(test::height_field(3, 2, 0.1f));
  for (auto& m : edit.texels(0).mean) m = 0.02f;
  for (auto& v : edit.texels(0).variance) v = 1e-4f;
  return edit.commit();
}

}  // namespace

TEST_CASE("sink.mesh_ply writes a file that a plain PLY reader understands") {
  test::TempFolder dir;
  const Registry& registry = test::builtin();
  const auto map = offset_map();
  for (const std::string surface : {"base", "displaced"}) {
    Harness h(registry, "sink.mesh_ply", "{surface: " + surface + ", file: " + surface + ".ply}", 1, 1, dir.path());
    h.belief().init(2, Pose::Identity(), map);
    h.tick();
    h.close();
    const auto ply = read_ply(dir / (surface + ".ply"));
    CHECK(ply.all_read);
    CHECK(ply.header[0] == "ply");
    CHECK(ply.header[1] == "format binary_little_endian 1.0");
    CHECK(ply.properties == std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "mean", "sigma"});
    const auto texels = static_cast<std::size_t>(map->stats().texels);
    REQUIRE(ply.vertex.size() >= (surface == "base" ? 12 : texels / 2));
    REQUIRE(ply.face.size() == (surface == "base" ? 12u : 12u * 6 * 6));
    for (const auto& v : ply.vertex) {
      CHECK(v[2] == Approx(surface == "base" ? 0.0f : 0.02f));
      CHECK(v[5] == Approx(1.0f));
      CHECK(v[6] == Approx(0.02f));
      CHECK(v[7] == Approx(0.01f));
    }
    for (const auto& f : ply.face) {
      REQUIRE(f.size() == 3);
      auto p = [&](std::size_t k) {
        return Eigen::Map<const Eigen::Vector3f>(ply.vertex.at(static_cast<std::size_t>(f[k])).data());
      };
      CHECK((p(1) - p(0)).cross(p(2) - p(0)).z() > 0);  // counter-clockwise from the side of the normals
    }
  }
}

TEST_CASE("sinks write the best particle's map") {
  test::TempFolder dir;
  const Registry& registry = test::builtin();
  const auto small = test::height_field(1, 1, 0.1f), large = test::height_field(4, 4, 0.1f);
  Harness h(registry, "sink.map_ppm", "{file: \"map_{frame}.ppm\"}", 1, 1, dir.path());
  h.belief().init(2, Pose::Identity(), small);
  h.belief().map[1] = large;
  h.belief().log_weight = {std::log(0.2), std::log(0.8)};
  h.tick();
  h.belief().log_weight = {std::log(0.9), std::log(0.1)};
  h.tick();
  CHECK(test::digest_of(*load_ppm(dir / "map_000000.ppm")) == test::digest_of(*large));
  CHECK(test::digest_of(*load_ppm(dir / "map_000001.ppm")) == test::digest_of(*small));
}

TEST_CASE("sink.export writes each format by its file's ending") {
  test::TempFolder dir;
  const Registry& registry = test::builtin();
  for (const std::string file : {"map.ply", "map.obj", "map.glb", "map.vdb", "map.png"}) {
    Harness h(registry, "sink.export", "{file: " + file + ", show: mean, surface: displaced, scale_low: -5 cm, scale_high: 5 cm}",
              1, 1, dir.path());
    h.belief().init(2, Pose::Identity(), offset_map());
    h.tick();
    CHECK(std::filesystem::file_size(dir / file) > 100);
  }
}

TEST_CASE("sink.export refuses endings and scales that make no sense before the first frame") {
  const Registry& registry = test::builtin();
  CHECK_THROWS_WITH(Harness(registry, "sink.export", "{file: map.stl}"), Catch::Contains("has no ending that names a format"));
  CHECK_THROWS_WITH(Harness(registry, "sink.export", "{scale_low: 2 cm, scale_high: 1 cm}"), Catch::Contains("above scale_low"));
  CHECK_THROWS_WITH(Harness(registry, "sink.export", "{show: sigma, scale_low: -2 cm, scale_high: 1 cm}"),
                    Catch::Contains("must be positive"));
}

TEST_CASE("a map without colour is exported without, and the log says so") {
  test::TempFolder dir;
  Harness h(test::builtin(), "sink.export", "{show: color}", 1, 1, dir.path());
  h.belief().init(1, Pose::Identity(), offset_map());
  h.tick();
  CHECK(std::filesystem::file_size(dir / "map.glb") > 100);
}

TEST_CASE("the frame's number stands for its placeholder") {
  CHECK(output_name("map.ply", 12) == "map.ply");
  CHECK(output_name("a_{frame}_{frame}.png", 12) == "a_000012_000012.png");
}
