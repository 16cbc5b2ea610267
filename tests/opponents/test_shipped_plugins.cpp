// Plug-ins that ship are named without a path; where one was not built, one message says what to install.
#include <catch2/catch.hpp>

#include "framework/graph/graph.hpp"
#include "tests/support/shipped_plugins.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

TEST_CASE("names of shipped plug-ins are letters, digits and underscores, anything else is a file") {
  CHECK(is_plugin_name("octomap"));
  CHECK(is_plugin_name("my_map2"));
  CHECK_FALSE(is_plugin_name("octomap.so"));
  CHECK_FALSE(is_plugin_name("./octomap"));
  CHECK_FALSE(is_plugin_name("/opt/octomap"));
  CHECK_FALSE(is_plugin_name(""));
}

TEST_CASE("a plug-in that was not built names the package to install") {
  const std::vector<ShippedPlugin> all{{"octomap", "liboctomap-dev", "/lib/octomap.so", false},
                                       {"tsdf", "libopen3d-dev", "/lib/tsdf.so", true}};
  CHECK(library_of("tsdf", all) == "/lib/tsdf.so");
  CHECK_THROWS_WITH(library_of("octomap", all),
                    "plug-in 'octomap' is not built: install the Debian package liboctomap-dev "
                    "(`bash apps/install_packages.sh --optional`) and build ppm again");
  CHECK_THROWS_WITH(library_of("octomop", all), Contains("no plug-in 'octomop'; did you mean 'octomap'? (it has: octomap, tsdf;"));
}

TEST_CASE("this ppm ships the plug-ins octomap and tsdf") {
  std::vector<std::string> names;
  for (const auto& plugin : shipped_plugins()) names.push_back(plugin.name);
  CHECK(names == std::vector<std::string>{"octomap", "tsdf"});
}

TEST_CASE("a plug-in that does not exist is an error at its place") {
  Registry registry = test::builtin();
  CHECK_THROWS_WITH(load_plugin("no_such", {"graph.yaml", 2, 12}, registry),
                    Contains("graph.yaml:2:12: ppm ships no plug-in 'no_such'"));
}

TEST_CASE("a graph's plug-ins that are names stay names") {
  const auto file = parse_yaml("name: g\nplugins: [tsdf, lib/a.so]\nnodes: []\n", "/home/me/g.yaml");
  const auto found = Graph::plugins(file);
  REQUIRE(found.size() == 2);
  CHECK(found[0].first == "tsdf");
  CHECK(found[1].first == "/home/me/lib/a.so");
}

TEST_CASE("a module of a plug-in that was not named says which one") {
  const auto file = parse_yaml("name: g\nnodes:\n  - {name: init, module: map.octomap}\n", "g.yaml");
  CHECK_THROWS_WITH(Graph::build(file, test::builtin()),
                    Contains("g.yaml:3:26: unknown module 'map.octomap'; modules of that name are in a plug-in: write "
                             "plugins: [octomap]"));
}
