// The graphs that ship, run for a few frames and compared with what they gave when they were written. Tolerances leave room for
// another seed's luck, not for a broken step.
#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"
#include "tests/support/data.hpp"

using namespace ppm::test;

namespace {

struct Golden {
  std::string graph;
  std::vector<std::string> options;
  double ate_m, coverage, median_mm;  // ATE and median at most, coverage at least
};

/// Returns run.json.
nlohmann::json runs_as_it_did(const Golden& golden) {
  INFO(golden.graph);
  TempFolder folder;
  const auto out = folder / "run";
  std::vector<std::string> arguments{"run", std::string(PPM_SOURCE_DIR) + "/configs/" + golden.graph, "--out", out.string(),
                                     "--frames", "10"};
  arguments.insert(arguments.end(), golden.options.begin(), golden.options.end());
  const auto run = ppm_command(std::move(arguments));
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto json = read_json(out / "run.json");
  CHECK(json["frames"] == 10);
  CHECK(json["trajectory"]["pairs"] == 10);
  CHECK(json["trajectory"]["ate_rmse_m"].get<double>() <= golden.ate_m);
  CHECK(json["holdout"]["coverage"].get<double>() >= golden.coverage);
  CHECK(json["holdout"]["median_mm"].get<double>() <= golden.median_mm);
  for (const char* file : {"map.ply", "map.ppm", "map.glb", "map.png", "metrics.csv", "trajectory.tum", "config.effective.yaml"})
    CHECK(std::filesystem::file_size(out / file) > 0);
  return json;
}

}  // namespace

TEST_CASE("room.yaml runs a few frames") {
  runs_as_it_did({"room.yaml", {}, 0.02, 0.9, 30});
}

TEST_CASE("room_color.yaml runs a few frames, and its colours are measured") {
  const auto color = runs_as_it_did({"room_color.yaml", {"--set", "init.particles=20"}, 0.04, 0.9, 30})["holdout"]["color"];
  CHECK(color["channels"] == 3);
  CHECK(color["median"].get<double>() < 0.02);
  CHECK(color["log_density"].get<double>() > 0.5);
}

TEST_CASE("the kitchen's graphs run a few frames") {
  const auto data = data_path("kitchen");
  if (!data) return;
  const std::string path = "camera.path=" + data->string();
  runs_as_it_did({"kitchen_mapping.yaml", {"--set", path}, 1e-6, 0.9, 12});
  runs_as_it_did({"kitchen_mapping_paper.yaml", {"--set", path}, 1e-6, 0.88, 12});
  runs_as_it_did({"kitchen_slam.yaml", {"--set", path}, 0.02, 0.9, 20});
  runs_as_it_did({"kitchen_slam_motion.yaml", {"--set", path, "--set", "init.particles=20"}, 0.03, 0.9, 25});
  runs_as_it_did({"kitchen_slam_color.yaml", {"--set", path, "--set", "init.particles=20"}, 0.03, 0.9, 25});
  runs_as_it_did({"kitchen_slam_shared.yaml", {"--set", path, "--set", "init.particles=50"}, 0.03, 0.7, 25});
  runs_as_it_did({"kitchen_slam_paper.yaml", {"--set", path, "--set", "init.particles=20"}, 0.1, 0.7, 100});
}

TEST_CASE("the simulated house's graphs run a few frames") {
  const auto data = data_path("house.ply");
  if (!data) return;
  const std::string file = "camera.file=" + data->string();
  runs_as_it_did({"house_mapping.yaml", {"--set", file}, 1e-6, 0.9, 20});
  runs_as_it_did({"house_slam_odometry.yaml", {"--set", file}, 0.02, 0.9, 25});
  runs_as_it_did({"house_slam.yaml", {"--set", file}, 0.02, 0.9, 30});
}

TEST_CASE("sr4000_still.yaml maps a place from four images") {
  const auto data = data_path("sr4000");
  if (!data) return;
  TempFolder folder;
  const auto run = ppm_command({"run", std::string(PPM_SOURCE_DIR) + "/configs/sr4000_still.yaml", "--out",
                                (folder / "run").string(), "--set", "camera.path=" + data->string()});
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto json = read_json(folder / "run/run.json");
  CHECK(json["frames"] == 4);
  CHECK(json["map"]["faces"].get<int>() > 300);
}

TEST_CASE("icl_slam.yaml runs a few frames") {
  const auto data = data_path("icl_kt3");
  if (!data) return;
  runs_as_it_did({"icl_slam.yaml", {"--set", "camera.path=" + data->string(), "--set", "init.particles=100"}, 0.03, 0.85, 25});
}
