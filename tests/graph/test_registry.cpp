#include <catch2/catch.hpp>

#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;

TEST_CASE("modules are found by name, listed in alphabetical order") {
  const auto& r = ToyRun::registry();
  REQUIRE(r.find("map.toy"));
  CHECK(r.find("map.toy")->summary == "Makes particles.");
  CHECK(r.find("map.none") == nullptr);
  const auto names = r.names();
  CHECK(std::is_sorted(names.begin(), names.end()));
}

TEST_CASE("a malformed or taken name is our own mistake") {
  Registry r;
  r.add<ToySource>("source.toy", "Counts.", "None.");
  CHECK_THROWS_AS(r.add<ToySource>("source.toy", "Counts.", "None."), InternalError);
  for (const auto* name : {"toy", "Source.toy", "source.", "source.toy.two", "source toy"}) {
    INFO(name);
    CHECK_THROWS_AS(r.add<ToySource>(name, "Counts.", "None."), InternalError);
  }
}
