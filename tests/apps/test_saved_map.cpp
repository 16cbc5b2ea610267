// A saved map is a start: to map on, and to localise in.
#include <array>
#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"
#include "tests/support/data.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

/// Mapping of the embedded room with known poses; INIT is filled in.
const char* const kMapping = R"(name: mapping
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 380, last: 39, pixel_stride: 4}}
  - INIT
  - {name: motion, module: motion.reference_pose, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.embree, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
  - {name: path, module: sink.trajectory_tum}
  - {name: save, module: sink.map_ppm, when: {at_end: true}}
)";
const char* const kEmpty = "{name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 1}}";
const char* const kSaved =
    "{name: init, module: map.ppm_file, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 1, path: FROM}}";

const char* const kLocalize = R"(name: localize
seed: 4
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 380, last: 39, pixel_stride: 4}}
  - {name: init, module: map.ppm_file, in: {frame: camera.frame}, when: {until_frame: 0}, params: {path: FROM, particles: 200, sigma_t: 1 cm, sigma_r: 0.5 deg}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1}, params: {sigma_t: 3 mm, sigma_r: 0.2 deg}}
  - {name: look, module: prediction.embree, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.robust, in: {frame: camera.frame}}
  - {name: pick, module: resampling.systematic}
  - {name: path, module: sink.trajectory_tum}
  - {name: save, module: sink.map_ppm, when: {at_end: true}}
)";

std::string with(std::string text, const std::string& word, const std::string& value) {
  text.replace(text.find(word), word.size(), value);
  return text;
}

struct Folder : TempFolder {
  /// Runs a graph into the folder `out`.
  void run(const std::string& graph, const std::string& out, std::vector<std::string> more = {}) const {
    write_text(*this / "graph.yaml", graph);
    std::vector<std::string> arguments{"run", (*this / "graph.yaml").string(), "--out", (*this / out).string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto process = ppm_command(std::move(arguments));
    INFO(process->err);
    REQUIRE(process->code == 0);
  }
  std::string path(const std::string& name) const { return (*this / name).string(); }
};

}  // namespace

// The second part begins with a frame in which grazing surface is made (update.grazing_every), as it would have been.
TEST_CASE("mapping on from a saved map gives the map of the run that did not stop, byte by byte") {
  const Folder folder;
  folder.run(with(kMapping, "INIT", kEmpty), "whole");
  folder.run(with(kMapping, "INIT", kEmpty), "first", {"--set", "camera.last=20"});
  const auto on = with(with(kMapping, "INIT", kSaved), "FROM", folder.path("first"));
  folder.run(on, "second", {"--set", "camera.first=21"});
  CHECK((content(folder / "second/map.ppm") == content(folder / "whole/map.ppm")));
  CHECK((content(folder / "second/map.ppm") != content(folder / "first/map.ppm")));
  const auto whole = lines(content(folder / "whole/trajectory.tum"));
  CHECK(lines(content(folder / "second/trajectory.tum")) == std::vector<std::string>(whole.begin() + 21, whole.end()));
}

TEST_CASE("a camera is localised in a saved map, which stays as it is") {
  const Folder folder;
  folder.run(with(kMapping, "INIT", kEmpty), "map", {"--set", "camera.stride=2"});
  folder.run(with(kLocalize, "FROM", folder.path("map/map.ppm")), "path");
  const auto report = read_json(folder / "path/run.json");
  CHECK(report["frames"] == 40);
  CHECK(report["trajectory"]["ate_rmse_m"].get<double>() < 0.06);
  CHECK((content(folder / "path/map.ppm") == content(folder / "map/map.ppm")));
  // Without an alignment, too: the map is in the reference's frame.
  folder.run(with(kMapping, "INIT", kEmpty), "reference");
  auto last_position = [&](const std::string& run) {
    std::istringstream line(lines(content(folder / (run + "/trajectory.tum"))).back());
    double stamp = 0, x = 0, y = 0, z = 0;
    line >> stamp >> x >> y >> z;
    return std::array{x, y, z};
  };
  const auto a = last_position("path"), b = last_position("reference");
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(a[k] - b[k]) < 0.08);
}

TEST_CASE("kitchen_localize.yaml finds images in the map of kitchen_mapping.yaml, from nowhere") {
  const auto data = data_path("kitchen");
  if (!data) return;
  TempFolder folder;
  const std::string camera = "camera.path=" + data->string(), map = (folder / "map").string();
  const std::string configs = std::string(PPM_SOURCE_DIR) + "/configs/";
  REQUIRE(ppm_command({"run", configs + "kitchen_mapping.yaml", "--set", camera, "--frames", "12", "--out", map})->code == 0);
  const auto run = ppm_command({"run", configs + "kitchen_localize.yaml", "--set", camera, "--set", "camera.first=3", "--set",
                                "init.path=" + map, "--set", "recover.path=" + map, "--frames", "10", "--out",
                                (folder / "path").string()});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK(run->err.find("place in the map is not known") != std::string::npos);
  CHECK(run->err.find("found, after 3 frames") != std::string::npos);
  CHECK(read_json(folder / "path/run.json")["trajectory"]["ate_rmse_m"].get<double>() < 0.03);
}
