// Every graph that ships passes all checks.
#include <catch2/catch.hpp>
#include <filesystem>

#include "framework/graph/graph.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

TEST_CASE("every graph in configs/ is sound") {
  int graphs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PPM_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path().filename());
    ++graphs;
    const Config file = load_yaml(entry.path());
    CHECK_NOTHROW(Graph::build(file, test::builtin()));
    const auto effective = Graph::build(file, test::builtin()).effective_yaml();
    CHECK(Graph::build(parse_yaml(effective, "effective"), test::builtin()).effective_yaml() == effective);
  }
  CHECK(graphs > 0);
}
