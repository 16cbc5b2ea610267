#include <catch2/catch.hpp>

#include "framework/core/error.hpp"

using namespace ppm;

TEST_CASE("errors say where and what, one line a mistake") {
  CHECK(to_string(Place{"g.yaml", 3, 7}) == "g.yaml:3:7");
  CHECK(to_string(Place{"g.yaml", 0, 0}) == "g.yaml");
  const ConfigError e(
      Diagnostics{{{"g.yaml", 3, 7}, "no such module"}, {{"--set a.b=1", 1, 5}, "wrong"}, {{}, "whole"}});
  CHECK(std::string(e.what()) == "g.yaml:3:7: no such module\n--set a.b=1:1:5: wrong\nwhole");
  CHECK(e.diagnostics().size() == 3);
  CHECK(std::string(DataError("a.png", "cut short").what()) == "a.png: cut short");
  CHECK(std::string(DataError("a.png", 12, "cut short").what()) == "a.png (frame 12): cut short");
}

TEST_CASE("PPM_CHECK names place, condition and values") {
  int i = 7;
  auto f = [&] { PPM_CHECK(i < 5, "i is {}", i); };
  CHECK_THROWS_AS(f(), InternalError);
  CHECK_THROWS_WITH(f(), Catch::Matchers::Contains("test_error.cpp") && Catch::Matchers::Contains("i < 5") &&
                             Catch::Matchers::Contains("i is 7"));
}
