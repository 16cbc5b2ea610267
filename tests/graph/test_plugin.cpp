#include <catch2/catch.hpp>

#include "framework/graph/graph.hpp"
#include "framework/graph/plugin.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

std::filesystem::path plugin(const std::string& name) {
  return std::filesystem::path(PPM_TEST_PLUGINS) / (name + ".so");
}

std::string mistake(const std::filesystem::path& library) {
  Registry registry = test::builtin();
  const auto before = registry.names();
  try {
    load_plugin(library, {"graph.yaml", 2, 12}, registry);
  } catch (const ConfigError& e) {
    CHECK(registry.names() == before);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a plug-in's module is found by name, once, and says where it is from") {
  Registry registry = test::builtin();
  load_plugin(plugin("drift"), {}, registry);
  load_plugin(plugin("drift"), {}, registry);
  const auto* info = registry.find("motion.drift");
  REQUIRE(info);
  CHECK(info->origin == std::filesystem::canonical(plugin("drift")).string());
  CHECK(info->make()->params().find("step")->unit() == "m");
}

TEST_CASE("what is no plug-in of this ppm is refused, with its place") {
  CHECK(mistake("no/such.so") == "graph.yaml:2:12: no plug-in no/such.so");
  CHECK_THAT(mistake(plugin("no_plugin")),
             Catch::StartsWith("graph.yaml:2:12: ") &&
                 Catch::Contains("is no ppm plug-in: it has no function 'ppm_plugin_abi'"));
  CHECK_THAT(mistake(plugin("wrong_stamp")), Catch::Contains("was built for another ppm") &&
                                                 Catch::Contains("plug-in: ppm 0.0.1, headers 0123456789abcdef\n") &&
                                                 Catch::Contains("ppm:     ppm 0.1.0, headers "));
  CHECK_THAT(mistake(plugin("taken_name")),
             Catch::Contains("module 'motion.constant_velocity' is there already (built in)"));
  CHECK_THAT(mistake(std::filesystem::path(PPM_SOURCE_DIR) / "README.md"),
             Catch::Contains("plug-in cannot be loaded: "));
}

TEST_CASE("plug-ins of a graph file start at its folder") {
  const auto found =
      Graph::plugins(parse_yaml("name: g\nplugins: [lib/a.so, /opt/b.so]\nnodes: []\n", "/home/me/g.yaml"));
  REQUIRE(found.size() == 2);
  CHECK(found[0].first == "/home/me/lib/a.so");
  CHECK(to_string(found[0].second) == "/home/me/g.yaml:2:11");
  CHECK(found[1].first == "/opt/b.so");
}
