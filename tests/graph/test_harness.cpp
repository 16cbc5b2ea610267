#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;

TEST_CASE("one module under test: inputs, outputs, frames") {
  Harness h(ToyRun::registry(), "preprocess.plus_one");
  h.input("number", std::make_shared<const ToyNumber>(ToyNumber{41}));
  CHECK(h.tick());
  CHECK(h.output<ToyNumber>("sum")->value == 42);
  CHECK(h.context().frame() == 0);
  h.tick();
  CHECK(h.context().frame() == 1);
}

TEST_CASE("a source under test says when it ends") {
  Harness h(ToyRun::registry(), "source.toy", "{count: 2}");
  CHECK(h.tick());
  CHECK(h.output<ToyNumber>("number")->value == 0);
  CHECK(h.tick());
  CHECK_FALSE(h.tick());
}

TEST_CASE("a particle module under test runs over the harness's belief") {
  Harness h(ToyRun::registry(), "motion.toy_walk", "{sigma: 1 cm}", 2);
  h.belief().init(5, Pose::Identity(), nullptr);
  h.input("number", std::make_shared<const ToyNumber>());
  h.tick();
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(h.belief().trajectory[i].length() == 1);
    CHECK(std::abs(h.belief().pose[i].translation().x()) < 0.1);
  }
}

TEST_CASE("the harness says what is wrong") {
  CHECK_THROWS_AS(Harness(ToyRun::registry(), "motion.toy_walk", "{sgma: 1}"), ConfigError);
  CHECK_THROWS_AS(Harness(ToyRun::registry(), "motion.none"), InternalError);
  Harness h(ToyRun::registry(), "preprocess.plus_one");
  CHECK_THROWS_AS(h.output<ToyNumber>("none"), InternalError);
  CHECK_THROWS_AS(h.input("number", std::make_shared<const ToyWord>()), InternalError);
  CHECK_THROWS_WITH(h.tick(), Catch::Contains("input 'number' has no value"));
}

TEST_CASE("random numbers are keyed by node, purpose, frame and particle") {
  Harness a(ToyRun::registry(), "motion.toy_walk"), b(ToyRun::registry(), "resampling.toy");
  const auto first = a.context().rng("step", 3).bits();
  CHECK(first == a.context().rng("step", 3).bits());
  CHECK(first != a.context().rng("step", 4).bits());
  CHECK(first != a.context().rng("turn", 3).bits());
  CHECK(first != b.context().rng("step", 3).bits());
}
