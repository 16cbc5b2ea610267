#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "framework/slam/tempering.hpp"

using ppm::temper_for_ess;

namespace {

double ess(const std::vector<double>& log_weight, const std::vector<double>& score, double exponent) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < score.size(); ++i) {
    const double w = std::exp(log_weight[i] + exponent * score[i]);
    sum += w;
    squares += w * w;
  }
  return sum * sum / squares;
}

}  // namespace

TEST_CASE("the exponent for a target ESS is the largest that reaches it") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 20);
  for (int run = 0; run < 50; ++run) {
    std::vector<double> score(100);
    for (auto& s : score) s = normal(random);
    const std::vector<double> even(score.size(), 0.0);
    const double exponent = temper_for_ess(even, score, 50, 1e-4);
    REQUIRE(exponent < 1);
    REQUIRE(ess(even, score, exponent) >= 50 - 1e-6);
    REQUIRE(ess(even, score, exponent * 1.001) < 50);
  }
}

TEST_CASE("of two particles whose log likelihoods differ by d, the exponent is known in closed form") {
  // ESS of weights 1 and x is (1 + x)^2 / (1 + x^2); 1.6 at x = 1/3.
  CHECK(temper_for_ess(std::vector<double>{0, 0}, std::vector<double>{0, -30}, 1.6, 1e-3) == Approx(std::log(3.0) / 30));
}

TEST_CASE("the exponent is 1 where the likelihood leaves the target, and the least where none reaches it") {
  const std::vector<double> even{0, 0, 0}, uneven{0, -50, -50}, flat{-1, -1, -1}, score{0, -400, -900};
  CHECK(temper_for_ess(even, flat, 2, 0.01) == 1);
  CHECK(temper_for_ess(uneven, flat, 2, 0.01) == 0.01);
  CHECK(temper_for_ess(even, score, 2, 0.05) == 0.05);
}

TEST_CASE("a particle without weight stays without, whatever the exponent") {
  const double none = -std::numeric_limits<double>::infinity();
  const double exponent = temper_for_ess(std::vector<double>{0, 0, 0}, std::vector<double>{none, 0, -9}, 1.9, 1e-3);
  CHECK(exponent < 1);
  CHECK(ess({0, 0}, {0, -9}, exponent) == Approx(1.9));
}
