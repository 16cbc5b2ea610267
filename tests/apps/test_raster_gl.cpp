// A machine without OpenGL: only the graph that asks for it fails, and says why.
#include <catch2/catch.hpp>
#include <cstdlib>

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

std::unique_ptr<Process> draw_a_frame(const TempFolder& folder) {
  std::string graph = kSmallRoom;
  const std::string embree = "prediction.embree";
  graph.replace(graph.find(embree), embree.size(), "prediction.raster_gl");
  write_text(folder / "graph.yaml", graph);
  return ppm_command({"run", (folder / "graph.yaml").string(), "--frames", "2", "--out", (folder / "run").string()});
}

}  // namespace

TEST_CASE("where EGL has no device a graph with prediction.raster_gl ends with the reason, and all else works") {
  const Environment no_driver("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent");
  TempFolder folder;
  const auto run = draw_a_frame(folder);
  CHECK(run->code == 1);
  CHECK_THAT(run->err, Catch::Contains("no device for OpenGL without a display") && Catch::Contains("node 'look'"));
  CHECK(ppm_command({"check", (folder / "graph.yaml").string()})->code == 0);
  CHECK(ppm_command({"list", "prediction"})->code == 0);
  CHECK(ppm_command({"describe", "prediction.raster_gl"})->code == 0);
}

TEST_CASE("a driver whose OpenGL is too old is named in the error") {
  const Environment old("MESA_GL_VERSION_OVERRIDE", "3.3");
  TempFolder folder;
  const auto run = draw_a_frame(folder);
  if (run->code == 0) return;  // not Mesa's
  CHECK(run->code == 1);
  CHECK_THAT(run->err, Catch::Contains("has no OpenGL 4.5") || Catch::Contains("no device for OpenGL"));
}
