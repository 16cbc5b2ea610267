// `ppm export`: what it writes and where, what it refuses and how.
#include <catch2/catch.hpp>
#include <set>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/ppm_file.hpp"
#include "tests/apps/command.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm::test;
using Catch::Contains;

namespace {

/// A folder with a map, as a run leaves it.
struct SavedMap {
  TempFolder folder;
  std::filesystem::path map = folder / "map.ppm";
  SavedMap() { ppm::save_ppm(*height_field(8, 6, 0.1f), map); }

  std::unique_ptr<Process> run(std::vector<std::string> options) const {
    std::vector<std::string> arguments{"export", folder.path().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return ppm_command(std::move(arguments));
  }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      names.insert(entry.path().filename().string());
    return names;
  }
};

}  // namespace

TEST_CASE("option --format writes beside the map, named after it and the surface") {
  const SavedMap saved;
  const auto run = saved.run({"--format", "ply,glb,obj,vdb,png", "--rows", "64", "--cols", "64"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK(saved.files() == std::set<std::string>{"map.ppm", "map_base.glb", "map_base.mtl", "map_base.obj",
                                               "map_base_texture.png", "map_displaced.ply", "map_displaced.png",
                                               "map_displaced.vdb"});
  CHECK_THAT(run->out, Contains("map_base.glb") && Contains("96 faces") &&
                           Contains("colours: standard deviation of the surface from "));
  CHECK(content(saved.folder / "map_displaced.ply").starts_with("ply\nformat binary_little_endian 1.0\n"));
  CHECK(content(saved.folder / "map_base.glb").starts_with("glTF"));
}

TEST_CASE("option --out names the file, and its ending the format") {
  const SavedMap saved;
  const auto file = saved.folder / "room.GLB";
  REQUIRE(saved.run({"--out", file.string(), "--surface", "displaced", "--show", "mean", "--range", "-2 cm", "2 cm"})->code == 0);
  CHECK(content(file).starts_with("glTF"));
  CHECK_THAT(content(file), Contains("\"colors\":\"mean\"") && Contains("\"scale\":\"linear\"") && Contains("\"surface\":\"displaced\""));
  const auto named = ppm_command({"export", saved.map.string(), "--out", (saved.folder / "x").string(), "--format", "ply", "--quiet"});
  CHECK(named->code == 0);
  CHECK(named->out.empty());
  CHECK(content(saved.folder / "x").starts_with("ply\n"));
}

TEST_CASE("what is there is replaced only with --force, and then nothing else is written either") {
  const SavedMap saved;
  write_text(saved.folder / "map_base_texture.png", "mine");
  const auto refused = saved.run({"--format", "glb,obj"});
  CHECK(refused->code == 2);
  CHECK_THAT(refused->err, Contains("map_base_texture.png: exists already; --force replaces it"));
  CHECK(saved.files() == std::set<std::string>{"map.ppm", "map_base_texture.png"});
  CHECK(saved.run({"--format", "glb,obj", "--force"})->code == 0);
  CHECK(content(saved.folder / "map_base_texture.png") != "mine");
}

TEST_CASE("mistakes on the command line are told with their place") {
  const SavedMap saved;
  auto refuses = [&](std::vector<std::string> options, const std::string& reason) {
    const auto run = saved.run(std::move(options));
    INFO(run->err);
    CHECK(run->code == 2);
    CHECK_THAT(run->err, Contains(reason));
    CHECK(saved.files() == std::set<std::string>{"map.ppm"});
  };
  refuses({}, "say which format");
  refuses({"--format", "stl"}, "stl");
  refuses({"--out", "map.stl"}, "names no format");
  refuses({"--format", "ply,obj", "--out", "x.ply"}, "several formats");
  refuses({"--format", "vdb", "--voxel", "2 deg"}, "'2 deg' is an angle; a length is wanted");
  refuses({"--format", "vdb", "--voxel", "0 m"}, "--voxel: must be positive");
  refuses({"--format", "ply", "--range", "5 cm", "1 cm"}, "below the upper");
  refuses({"--format", "ply", "--range", "-1 cm", "1 cm"}, "must be positive");
  refuses({"--format", "png", "--pose", "0"}, "has 0 poses");
  refuses({"--format", "glb", "--show", "color"}, "map.ppm: has no colour to show");
}

TEST_CASE("a run without a map, a map that is cut short, and a folder that cannot be written") {
  const SavedMap saved;
  TempFolder empty;
  const auto none = ppm_command({"export", empty.path().string(), "--format", "ply"});
  CHECK(none->code == 2);
  CHECK_THAT(none->err, Contains("the folder holds no map.ppm"));

  const auto nowhere = ppm_command({"export", saved.map.string(), "--out", (empty / "no/map.ply").string()});
  CHECK(nowhere->code == 1);
  CHECK_THAT(nowhere->err, Contains("cannot write") && Contains("no/map.ply"));

  write_text(saved.map, content(saved.map).substr(0, 2000));
  const auto cut = saved.run({"--format", "ply"});
  CHECK(cut->code == 2);
  CHECK_THAT(cut->err, Contains("map.ppm: is cut short"));
  CHECK(saved.files() == std::set<std::string>{"map.ppm"});
}
