#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "tests/preprocess/filtered.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

/// One row: depth 1, 2, 3, 4 m and none; sigma 1, 2, 3, 4 mm.
Frame row() {
  Frame f;
  f.index = 12;
  f.camera = {5, 1, 10, 10, 2, 0};
  f.depth = {1, 2, 3, 4, kNoReturn};
  f.sigma = {0.001f, 0.002f, 0.003f, 0.004f, kNoReturn};
  return f;
}

std::vector<std::size_t> gated(const Frame& frame, const std::string& params) {
  return dropped(frame, *filtered("preprocess.gate", params, frame));
}

using Pixels = std::vector<std::size_t>;

}  // namespace

TEST_CASE("the gate passes what lies within its limits, both ends allowed") {
  CHECK(gated(row(), "{}").empty());
  CHECK(gated(row(), "{min_range: 2}") == Pixels{0});
  CHECK(gated(row(), "{max_range: 2}") == Pixels{2, 3});
  CHECK(gated(row(), "{sigma_most: 3.1 mm}") == Pixels{3});
  Frame frame = row();
  frame.confidence = {100, 50, 20, 0, 0};
  CHECK(gated(frame, "{}").empty());
  CHECK(gated(frame, "{confidence_least: 50}") == Pixels{2, 3});
  CHECK(filtered("preprocess.gate", "{confidence_least: 50}", frame)->confidence == frame.confidence);
}

TEST_CASE("a confidence that the frames do not have cannot be asked for") {
  CHECK_THROWS_AS(gated(row(), "{confidence_least: 1}"), DataError);
  CHECK_THROWS_WITH(gated(row(), "{confidence_least: 1}"), Contains("frame 12") && Contains("no confidence"));
  CHECK_THROWS_AS(gated(row(), "{max_range: 3 deg}"), ConfigError);
}

TEST_CASE("preprocessing records the share that it dropped") {
  Harness h(builtin(), "preprocess.gate", "{max_range: 3}");
  h.input("frame", std::make_shared<const Frame>(row()));
  h.tick();
  const auto& columns = h.context().metrics().columns();
  REQUIRE(columns.size() == 1);
  CHECK_THAT(columns.begin()->first, Contains("dropped"));
  CHECK(columns.begin()->second.at(0).value == Approx(0.25));
}
