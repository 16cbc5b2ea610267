// The maps of other people's libraries in the filter: graphs that name the plug-in run, with the same bytes for any number
// of threads and after a resume.
#include "tests/apps/same_results.hpp"
#include "tests/support/shipped_plugins.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

/// SLAM in the embedded room with a map of another kind, on every eighth pixel.
std::string graph_of(const std::string& kind, const std::string& map_params) {
  return "name: " + kind + "\nseed: 3\nplugins: [" + kind + "]\nnodes:\n" +
         R"(  - {name: camera, module: source.synthetic_room, params: {frames: 24, pixel_stride: 8, holdout: every 5th}}
  - {name: init, module: map.)" + kind + R"(, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 4, )" +
         map_params + R"(}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1},
     params: {sigma_t: 3 mm, sigma_r: 0.2 deg}}
  - {name: look, module: prediction.)" + kind + R"(, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: pick, module: resampling.systematic, when: {from_frame: 1}, params: {ess_below: 0.9}}
  - {name: update, module: map_update.)" + kind + R"(, in: {frame: camera.frame}}
  - {name: path, module: sink.trajectory_tum}
  - {name: table, module: sink.metrics, params: {memory_every: 3}}
  - {name: mesh, module: sink.mesh_ply, when: {at_end: true}}
)";
}

void runs_the_same_always(const std::string& kind, const std::string& map_params) {
  if (!built(kind)) return;
  TempFolder folder;
  const auto graph = folder / (kind + ".yaml");
  write_text(graph, graph_of(kind, map_params));
  auto run = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> arguments{"run", graph.string(), "--quiet", "--out", (folder / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto done = ppm_command(arguments);
    INFO(done->err);
    REQUIRE(done->code == 0);
  };
  run("whole", {"--threads", "1"});
  run("other", {"--threads", "3"});
  same_results(folder / "whole", folder / "other");
  run("run", {"--checkpoint-every", "4", "--frames", "9", "--threads", "2"});
  const auto resumed = ppm_command({"run", "--resume", (folder / "run").string(), "--frames", "1000", "--quiet"});
  INFO(resumed->err);
  REQUIRE(resumed->code == 0);
  same_results(folder / "whole", folder / "run");

  const auto report = read_json(folder / "whole/run.json");
  CHECK(report["map"]["kind"] == kind);
  CHECK(report["holdout"]["coverage"].get<double>() > 0.7);
  CHECK_THAT(content(folder / "whole/config.effective.yaml"), Contains("plugins") && Contains(kind));
}

}  // namespace

TEST_CASE("SLAM on an OctoMap: the same bytes for any number of threads, and after a resume") {
  runs_the_same_always("octomap", "voxel_size: 5 cm");
}

TEST_CASE("SLAM on a TSDF: the same bytes for any number of threads, and after a resume") {
  runs_the_same_always("tsdf", "voxel_size: 4 cm, truncation: 16 cm");
}

TEST_CASE("a kind of map asks for the prediction and the update of its own kind") {
  if (!built("octomap")) return;
  TempFolder folder;
  auto text = graph_of("octomap", "voxel_size: 5 cm");
  text.replace(text.find("prediction.octomap"), 18, "prediction.raster");
  write_text(folder / "mixed.yaml", text);
  const auto check = ppm_command({"check", (folder / "mixed.yaml").string()});
  CHECK(check->code == 2);
  CHECK_THAT(check->err, Contains("needs a 'ppm' map, but node 'init' gives 'octomap'"));
}

TEST_CASE("a truncation of less than two voxels is a mistake of the graph") {
  if (!built("tsdf")) return;
  TempFolder folder;
  write_text(folder / "thin.yaml", graph_of("tsdf", "voxel_size: 4 cm, truncation: 5 cm"));
  const auto check = ppm_command({"check", (folder / "thin.yaml").string()});
  CHECK(check->code == 2);
  CHECK_THAT(check->err, Contains("thin.yaml:6:") && Contains("must be at least two voxels"));
}
