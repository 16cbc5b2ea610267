#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

/// Plug-ins built from what `ppm new-module` writes, one a category (see tests/CMakeLists.txt).
std::string skeleton(const std::string& category) {
  return std::string(PPM_SKELETONS) + "/skeleton_" + category + ".so";
}

}  // namespace

TEST_CASE("new-module writes a source once and tells how to build it") {
  TempFolder folder;
  const auto made = ppm_command({"new-module", "motion.mine", "--dir", folder.path().string()});
  CHECK(made->code == 0);
  CHECK_THAT(made->out, Contains("ppm_add_plugin(mine mine.cpp)") && Contains("--plugin build/mine.so"));
  const auto text = content(folder / "mine.cpp");
  CHECK_THAT(text, Contains("class Mine final") && Contains("\"motion.mine\"") && !Contains("NewModule") &&
                       !Contains("category.name"));

  write_text(folder / "mine.cpp", "edited");
  const auto again = ppm_command({"new-module", "motion.mine", "--dir", folder.path().string()});
  CHECK(again->code == 2);
  CHECK_THAT(again->err, Contains("not overwritten"));
  CHECK(content(folder / "mine.cpp") == "edited");
}

TEST_CASE("new-module inside the project names the one line of the build") {
  TempFolder folder;
  std::filesystem::create_directory(folder / "modules");
  write_text(folder / "modules/CMakeLists.txt", "");
  Process made({"/usr/bin/env", "-C", folder.path().string(), PPM_BINARY, "new-module", "sink.my_table"});
  made.wait();
  CHECK(made.code == 0);
  CHECK_THAT(made.out, Contains("ppm_add_module(sinks/my_table.cpp)"));
  CHECK_THAT(content(folder / "modules/sinks/my_table.cpp"), Contains("class MyTable final"));
}

TEST_CASE("new-module refuses names that are malformed or taken") {
  TempFolder folder;
  for (const char* name : {"mine", "motion.", ".mine", "Motion.Mine", "motion.my-module", "a.b.c", "motion.1st",
                           "../x.y", "motion.constant_velocity"}) {
    CAPTURE(name);
    CHECK(ppm_command({"new-module", name, "--dir", folder.path().string()})->code == 2);
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("skeletons of all categories compile as they are, load as plug-ins and run together") {
  TempFolder folder;
  const auto graph = (folder / "graph.yaml").string();
  write_text(graph, R"(name: skeletons
nodes:
  - {name: camera, module: source.skeleton_source, params: {frames: 4}}
  - {name: noise, module: sensor.skeleton_sensor, in: {frame: camera.frame}}
  - {name: clean, module: preprocess.skeleton_preprocess, in: {frame: noise.frame}}
  - {name: init, module: map.ppm_empty, in: {frame: clean.frame}, when: {until_frame: 0}, params: {particles: 3}}
  - {name: motion, module: motion.skeleton_motion, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.skeleton_prediction, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.skeleton_weighting, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: update, module: map_update.skeleton_map_update, in: {frame: clean.frame}}
  - {name: adjust, module: refinement.skeleton_refinement}
  - {name: table, module: sink.skeleton_sink}
)");
  std::vector<std::string> arguments{"run", graph, "--out", (folder / "run").string()};
  for (const char* category :
       {"source", "sensor", "preprocess", "motion", "prediction", "weighting", "map_update", "refinement", "sink"}) {
    arguments.emplace_back("--plugin");
    arguments.push_back(skeleton(category));
  }
  const auto run = ppm_command(std::move(arguments));
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK(read_json(folder / "run/run.json")["frames"] == 4);
  CHECK(lines(content(folder / "run/sink.skeleton_sink.txt")).size() == 4);
}
