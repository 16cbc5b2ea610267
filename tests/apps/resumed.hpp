#pragma once
#include <catch2/catch.hpp>
#include <set>
#include <thread>

#include "tests/apps/command.hpp"

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

/// metrics.csv without the columns of acceleration structures built in a frame: after a resume all are built anew.
inline std::vector<std::string> lasting_metrics(const std::filesystem::path& file) {
  std::vector<std::string> rows;
  std::vector<bool> keep;
  for (const auto& line : lines(content(file))) {
    std::istringstream fields(line);
    std::string row;
    std::size_t column = 0;
    for (std::string field; std::getline(fields, field, ','); ++column) {
      if (rows.empty()) keep.push_back(!field.ends_with(".built"));
      if (keep[column]) row += field + ",";
    }
    rows.push_back(row);
  }
  return rows;
}

/// Two runs ended with the same results, though one had been stopped.
inline void same_results(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto report_a = read_json(a / "run.json"), report_b = read_json(b / "run.json");
  for (const char* key : {"digest", "frames", "last_index", "interrupted", "particles", "ess_mean", "map", "trajectory", "holdout"}) {
    INFO(key);
    CHECK(report_a[key] == report_b[key]);
  }
  for (const auto& node : report_a["nodes"].items()) {
    INFO(node.key());
    CHECK(node.value()["runs"] == report_b["nodes"][node.key()]["runs"]);
  }
  CHECK(lasting_metrics(a / "metrics.csv") == lasting_metrics(b / "metrics.csv"));
  std::set<std::string> files_a = report_a["files"], files_b = report_b["files"];
  files_b.erase("run.checkpoint");
  CHECK(files_a == files_b);
  for (const auto& name : files_a) {
    INFO(name);
    if (name != "metrics.csv" && name != "config.effective.yaml") CHECK((content(a / name) == content(b / name)));
  }
}

/// Waits until a file is there: a minute at most.
inline void wait_for(const std::filesystem::path& file) {
  for (int i = 0; i < 30'000 && !std::filesystem::exists(file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  REQUIRE(std::filesystem::exists(file));
}

}  // namespace ppm::test
