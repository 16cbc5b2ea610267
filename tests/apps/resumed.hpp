#pragma once
#include <thread>

#include "tests/apps/same_results.hpp"

namespace ppm::test {

/// A graph that resamples, with a plug-in's motion, on small images.
inline const char* const kWindyRoom = R"(name: windy
seed: 3
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 60, pixel_stride: 8, holdout: every 5th}}
  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 9}}
  - {name: motion, module: motion.gust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.embree, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: pick, module: resampling.systematic, when: {from_frame: 1}, params: {ess_below: 0.9}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
  - {name: path, module: sink.trajectory_tum}
  - {name: table, module: sink.metrics, params: {memory_every: 3}}
  - {name: image, module: sink.image, when: {every: 20}, params: {file: "map-{frame}.png", cols: 80, rows: 60}}
  - {name: mesh, module: sink.mesh_ply, when: {at_end: true}}
  - {name: save, module: sink.map_ppm, when: {at_end: true}}
)";

/// A folder with that graph, run without a stop.
struct WindyRoom {
  TempFolder folder;
  std::string graph = (folder / "windy.yaml").string();
  std::string plugin = std::string(PPM_TEST_PLUGINS) + "/gust.so";
  std::filesystem::path whole = folder / "whole", out = folder / "run";

  WindyRoom() { write_text(graph, kWindyRoom); }
  std::vector<std::string> arguments(const std::filesystem::path& to, std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"run", graph, "--plugin", plugin, "--out", to.string(), "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void run_whole() const { REQUIRE(ppm_command(arguments(whole))->code == 0); }
};

/// Waits until a file is there: a minute at most.
inline void wait_for(const std::filesystem::path& file) {
  for (int i = 0; i < 30'000 && !std::filesystem::exists(file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  REQUIRE(std::filesystem::exists(file));
}

}  // namespace ppm::test
