// Pages and schema are made from the code: what is in the tree must be what the code says now (the build target `pages`
// makes them anew). They are of all plug-ins that ship, too.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/graph/describe.hpp"
#include "tests/support/shipped_plugins.hpp"

using namespace ppm;

namespace {

const std::filesystem::path kRoot = PPM_SOURCE_DIR;

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("docs/modules is what `ppm describe --pages docs/modules` writes") {
  if (!test::all_built()) return;
  const auto pages = module_pages(test::shipped());
  for (const auto& [name, text] : pages) {
    INFO(name);
    CHECK((read(kRoot / "docs/modules" / name) == text));  // without printing both
  }
  REQUIRE(std::filesystem::exists(kRoot / "docs/modules"));
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "docs/modules")) {
    INFO(entry.path().filename());
    CHECK(pages.contains(entry.path().filename().string()));
  }
}

TEST_CASE("configs/schema/graph.schema.json is what `ppm schema` prints") {
  if (!test::all_built()) return;
  CHECK((read(kRoot / "configs/schema/graph.schema.json") == graph_schema(test::shipped())));
}
