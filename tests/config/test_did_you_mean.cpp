#include <catch2/catch.hpp>

#include "framework/config/config.hpp"

using ppm::did_you_mean;

TEST_CASE("a slip of the fingers finds the word") {
  const std::vector<std::string> names{"sigma_r", "sigma_t", "particles", "ess_below", "weighting.gaussian"};
  CHECK(did_you_mean("sigma_tt", names) == "sigma_t");
  CHECK(did_you_mean("simga_t", names) == "sigma_t");
  CHECK(did_you_mean("particle", names) == "particles");
  CHECK(did_you_mean("Particles", names) == "particles");
  CHECK(did_you_mean("weighting.gausian", names) == "weighting.gaussian");
  CHECK(did_you_mean("ess_belwo", names) == "ess_below");
}

TEST_CASE("at most a third of the letters may differ, at least one") {
  CHECK(did_you_mean("abcdef", {"abcdxy"}) == "abcdxy");
  CHECK(did_you_mean("abcdef", {"abcxyz"}) == "");
  CHECK(did_you_mean("ab", {"ax"}) == "ax");
  CHECK(did_you_mean("ab", {"xy"}) == "");
  CHECK(did_you_mean("anything", {}) == "");
}

TEST_CASE("the nearest wins, the first among equals") {
  CHECK(did_you_mean("sigma", {"sigma_x", "sigmas"}) == "sigmas");
  CHECK(did_you_mean("sigma_q", {"sigma_t", "sigma_r"}) == "sigma_t");
  CHECK(did_you_mean("sigma_q", {"sigma_r", "sigma_t"}) == "sigma_r");
}
