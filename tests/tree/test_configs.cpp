// Every graph that ships passes all checks.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "framework/graph/graph.hpp"
#include "tests/support/shipped_plugins.hpp"

using namespace ppm;

TEST_CASE("every graph in configs/ is sound") {
  int graphs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PPM_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path().filename());
    ++graphs;
    const Config file = load_yaml(entry.path());
    const auto plugins = Graph::plugins(file);
    if (!std::ranges::all_of(plugins, [](const auto& plugin) { return test::built(plugin.first.string()); })) continue;
    CHECK_NOTHROW(Graph::build(file, test::shipped()));
    const auto effective = Graph::build(file, test::shipped()).effective_yaml();
    CHECK(Graph::build(parse_yaml(effective, "effective"), test::shipped()).effective_yaml() == effective);
  }
  CHECK(graphs > 0);
}
