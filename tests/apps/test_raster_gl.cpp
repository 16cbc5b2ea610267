// A machine without OpenGL: only the graph that asks for it fails, and says why.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

#include "tests/apps/command.hpp"

using namespace ppm::test;

namespace {

// Sets a variable of the environment for the processes that are started meanwhile.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { ::unsetenv(name_); }

 private:
  const char* name_;
};

// The small room, drawn by OpenGL: each particle looks twice, at few pixels for its weight and at all for its map.
std::unique_ptr<Process> draw_room(const TempFolder& folder, const std::string& threads = "1") {
  std::string graph = kSmallRoom;
  const std::string embree = "prediction.embree, in: {frame: camera.frame}}";
  const std::string look =
      "prediction.raster_gl, in: {frame: camera.frame}, when: {from_frame: 1}, params: {stride: 2}}";
  graph.replace(graph.find(embree), embree.size(), look);
  graph.insert(graph.find("  - {name: update"),
               "  - {name: view, module: prediction.raster_gl, in: {frame: camera.frame}}\n");
  write_text(folder / "graph.yaml", graph);
  return ppm_command({"run", (folder / "graph.yaml").string(), "--frames", "6", "--threads", threads, "--out",
                      (folder / "run").string()});
}

}  // namespace

TEST_CASE("a graph with two nodes that draw runs, with the same result for any number of threads") {
  std::string digest;
  for (const char* threads : {"1", "2", "3"}) {
    TempFolder folder;
    const auto run = draw_room(folder, threads);
    if (run->code == 1 && run->err.find("no device for OpenGL") != std::string::npos) {
      std::cout << "SKIPPED: " << run->err;
      return;
    }
    INFO(run->err);
    REQUIRE(run->code == 0);
    const auto json = read_json(folder / "run" / "run.json");
    if (digest.empty()) digest = json["digest"].get<std::string>();
    CHECK(json["digest"] == digest);
    CHECK(json["trajectory"]["ate_rmse_m"].get<double>() < 0.02);
    CHECK(json["holdout"]["coverage"].get<double>() > 0.7);
  }
}

TEST_CASE("where EGL has no device a graph with prediction.raster_gl ends with the reason, and all else works") {
  const Environment no_driver("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent");
  TempFolder folder;
  const auto run = draw_room(folder);
  CHECK(run->code == 1);
  CHECK_THAT(run->err, Catch::Contains("no device for OpenGL without a display") && Catch::Contains("node 'look'"));
  CHECK(ppm_command({"check", (folder / "graph.yaml").string()})->code == 0);
  CHECK(ppm_command({"list", "prediction"})->code == 0);
  CHECK(ppm_command({"describe", "prediction.raster_gl"})->code == 0);
}

TEST_CASE("a driver whose OpenGL is too old is named in the error") {
  const Environment old("MESA_GL_VERSION_OVERRIDE", "3.3");
  TempFolder folder;
  const auto run = draw_room(folder);
  if (run->code == 0) return;  // not Mesa's
  CHECK(run->code == 1);
  CHECK_THAT(run->err, Catch::Contains("has no OpenGL 4.5") || Catch::Contains("no device for OpenGL"));
}
