#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a run replaces an earlier run, and leaves other files alone") {
  SmallRoom room;
  REQUIRE(room.run({"--frames", "2"})->code == 0);
  write_text(room.out / "notes.txt", "mine");
  REQUIRE(fs::exists(room.out / "metrics.csv"));

  auto text = content(room.graph);
  text.erase(text.find("  - {name: table"), text.find("  - {name: save") - text.find("  - {name: table"));
  write_text(room.graph, text);
  const auto run = room.run({"--frames", "3"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK(read_json(room.out / "run.json")["frames"] == 3);
  CHECK_FALSE(fs::exists(room.out / "metrics.csv"));  // of the earlier run: nothing here wrote it
  CHECK(content(room.out / "notes.txt") == "mine");
}

TEST_CASE("a folder with other things is written to only when told so") {
  SmallRoom room;
  fs::create_directory(room.out);
  write_text(room.out / "thesis.tex", "years of work");
  const auto refused = room.run({"--frames", "1"});
  CHECK(refused->code == 2);
  CHECK_THAT(refused->err, Contains(room.out.string()) && Contains("--force"));
  CHECK(std::distance(fs::directory_iterator(room.out), {}) == 1);

  CHECK(room.run({"--frames", "1", "--force"})->code == 0);
  CHECK(content(room.out / "thesis.tex") == "years of work");
}

TEST_CASE("an output folder that is a file, or lies in one") {
  SmallRoom room;
  write_text(room.out, "a file");
  CHECK(room.run()->code == 2);
  const auto inside = ppm_command({"run", room.graph, "--out", (room.out / "run").string()});
  CHECK(inside->code == 1);
  CHECK_THAT(inside->err, Contains("cannot make the folder"));
  CHECK(content(room.out) == "a file");
}

TEST_CASE("a list of files in run.json cannot reach out of the folder") {
  SmallRoom room;
  fs::create_directory(room.out);
  write_text(room.folder / "precious.txt", "x");
  write_text(room.out / "run.json", R"({"files": ["../precious.txt", 5, "old.txt"]})");
  write_text(room.out / "old.txt", "x");
  REQUIRE(room.run({"--frames", "1"})->code == 0);
  CHECK(fs::exists(room.folder / "precious.txt"));
  CHECK_FALSE(fs::exists(room.out / "old.txt"));
}

TEST_CASE("input that cannot be read leaves nothing, and an earlier run untouched") {
  SmallRoom room;
  const std::string graph = (room.folder / "broken.yaml").string();
  fs::create_directory(room.folder / "images");
  write_text(room.folder / "images/frame-000000.depth.png", "\x89PNG\r\n\x1a\n cut short");
  write_text(room.folder / "images/camera-intrinsics.txt", "525 0 319.5\n0 525 239.5\n0 0 1\n");
  write_text(room.folder / "images/frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  write_text(graph,
             "name: broken\nnodes:\n  - {name: camera, module: source.seven_scenes, params: {path: \"" +
                 (room.folder / "images").string() +
                 "\"}}\n  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}}\n");
  auto run = ppm_command({"run", graph, "--out", room.out.string()});
  CHECK(run->code == 2);
  CHECK_THAT(run->err, Contains("frame-000000.depth.png"));
  CHECK_FALSE(fs::exists(room.out));

  REQUIRE(room.run({"--frames", "2"})->code == 0);
  const auto before = content(room.out / "run.json");
  run = ppm_command({"run", graph, "--out", room.out.string()});
  CHECK(run->code == 2);
  CHECK(content(room.out / "run.json") == before);
  CHECK(fs::exists(room.out / "trajectory.tum"));
}
