#pragma once
#include <string>

#include "apps/compare/plan.hpp"
#include "tests/apps/command.hpp"

namespace ppm::test {

/// A folder with two graphs and a suite that is given.
struct SuiteFiles {
  TempFolder folder;

  SuiteFiles() {
    write_text(folder / "room.yaml", R"(name: room
seed: 3
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 6, pixel_stride: 8}}
  - {name: solid, module: preprocess.flying_pixels, in: {frame: camera.frame}}
  - {name: init, module: map.ppm_empty, in: {frame: solid.frame}, when: {until_frame: 0}, params: {particles: 1}}
  - {name: motion, module: motion.reference_pose, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.raster, in: {frame: solid.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: solid.frame}}
  - {name: table, module: sink.metrics}
)");
    write_text(folder / "plain.yaml", R"(name: plain
nodes:
  - {name: eye, module: source.synthetic_room, params: {frames: 4, pixel_stride: 8}}
  - {name: init, module: map.ppm_empty, in: {frame: eye.frame}, when: {until_frame: 0}, params: {particles: 1}}
  - {name: motion, module: motion.reference_pose, in: {frame: eye.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.raster, in: {frame: eye.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: eye.frame}}
)");
  }

  std::string suite_file() const { return (folder / "suite.yaml").string(); }
  Suite suite(const std::string& text) const {
    write_text(suite_file(), text);
    return read_suite(suite_file());
  }
  Plan plan(const std::string& text) const { return make_plan(suite(text)); }
  /// Messages of the mistakes of a suite, with "SUITE" in place of its file and "DIR/" of its folder.
  std::string complaint(const std::string& text) const {
    try {
      plan(text);
    } catch (const ConfigError& e) {
      std::string what = e.what();
      auto replace = [&](const std::string& from, const std::string& to) {
        for (auto at = what.find(from); at != std::string::npos; at = what.find(from)) what.replace(at, from.size(), to);
      };
      replace(suite_file(), "SUITE");
      replace(folder.path().string() + "/", "DIR/");
      return what;
    }
    return "";
  }
};

}  // namespace ppm::test
