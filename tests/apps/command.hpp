#pragma once
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace ppm::test {

inline std::unique_ptr<Process> start_ppm(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), PPM_BINARY);
  return std::make_unique<Process>(std::move(arguments));
}

/// Runs `ppm ARGUMENTS...` to its end.
inline std::unique_ptr<Process> ppm_command(std::vector<std::string> arguments) {
  auto process = start_ppm(std::move(arguments));
  process->wait();
  return process;
}

inline std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

inline nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(content(file));
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// Names of the files in a folder that were left half-written.
inline std::vector<std::string> half_written(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  if (!std::filesystem::exists(folder)) return names;
  for (const auto& e : std::filesystem::directory_iterator(folder))
    if (e.path().extension() == ".part") names.push_back(e.path().filename().string());
  return names;
}

/// SLAM in the embedded room with a handful of particles, on every fourth pixel.
inline const char* const kSmallRoom = R"(name: small
seed: 3
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 12, pixel_stride: 4, holdout: every 5th}}
  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 6}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1}, params: {sigma_t: 4 mm, sigma_r: 0.3 deg}}
  - {name: look, module: prediction.embree, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: pick, module: resampling.systematic, when: {from_frame: 1}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
  - {name: path, module: sink.trajectory_tum}
  - {name: table, module: sink.metrics}
  - {name: save, module: sink.map_ppm, when: {at_end: true}}
)";

/// A folder with the graph of the small room.
struct SmallRoom {
  TempFolder folder;
  std::string graph = (folder / "small.yaml").string();
  std::filesystem::path out = folder / "run";
  SmallRoom() { write_text(graph, kSmallRoom); }
  std::unique_ptr<Process> run(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", graph, "--out", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ppm_command(std::move(arguments));
  }
};

}  // namespace ppm::test
