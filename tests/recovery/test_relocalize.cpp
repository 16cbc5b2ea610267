#include <catch2/catch.hpp>
#include <numeric>

#include "framework/slam/belief_digest.hpp"
#include "tests/recovery/carried_camera.hpp"

using namespace ppm;
using ppm::test::CarriedRun;

namespace {

std::string slam(const std::string& stretches, const std::string& recover = "{}") {
  return R"(
name: carried
seed: 3
nodes:
  - {name: camera, module: source.carried, params: {stretches: ")" + stretches + R"(", pixel_stride: 2}}
  - {name: init,   module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 4}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1},
     params: {sigma_t: 1 cm, sigma_r: 0.5 deg}}
  - {name: align,  module: motion.aligned, in: {frame: camera.frame, view: look}, when: {from_frame: 1}}
  - {name: look,   module: prediction.raster, in: {frame: camera.frame}, when: {from_frame: 1}, params: {stride: 4}}
  - {name: weigh,  module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: recover, module: recovery.relocalize, in: {frame: camera.frame, view: look}, when: {from_frame: 1}, params: )" + recover + R"(}
  - {name: pick,   module: resampling.systematic, when: {from_frame: 1}, params: {number: fixed, particles: 4}}
  - {name: view,   module: prediction.raster, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
)";
}

/// How far the best particle is from where its path was when the camera was at the same place earlier, whatever drift there is.
double apart_m(const CarriedRun& run, std::size_t earlier_frame) {
  const auto path = run.belief().trajectory[run.belief().best()].poses();
  return (path.back().T_map_camera.translation() - path[earlier_frame].T_map_camera.translation()).norm();
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("a camera that is carried to a place that the map has is found there") {
  CarriedRun run(slam("0-110 30-60"));
  run.run_to(56);
  CHECK_FALSE(run.belief().lost);
  CHECK(total(run.metric("recover.lost")) == 0);
  run.run_to(1000);
  CHECK_FALSE(run.belief().lost);
  CHECK(apart_m(run, 30) < 0.02);
  const double frames = total(run.metric("recover.lost"));
  CHECK(frames > 0);
  CHECK(frames < 12);
}

TEST_CASE("a camera in an unknown place stays lost, teaches the map nothing, and is found when it comes back") {
  CarriedRun run(slam("0-80 180-210 40-70"));
  run.run_to(41);
  const std::vector<MapHandle> maps = run.belief().map;
  run.run_to(57);
  CHECK(run.belief().lost);
  for (const auto& map : run.belief().map) CHECK(std::ranges::find(maps, map) != maps.end());
  CHECK(total(run.metric("recover.accepted")) == 0);
  run.run_to(1000);
  CHECK_FALSE(run.belief().lost);
  CHECK(apart_m(run, 35) < 0.02);
}
