#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "tests/support/resampling.hpp"

using ppm::test::copies;

namespace {

std::vector<double> random_weights(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-12, 0);
  std::vector<double> w(n);
  for (auto& x : w) x = std::exp(u(random));
  const double sum = std::accumulate(w.begin(), w.end(), 0.0);
  for (auto& x : w) x /= sum;
  return w;
}

double last_metric(ppm::Harness& h, const std::string& name) {
  return h.context().metrics().columns().at("resampling.systematic." + name).back().value;
}

const std::string kAll[] = {"resampling.systematic", "resampling.stratified", "resampling.residual",
                            "resampling.multinomial"};

}  // namespace

TEST_CASE("systematic: each particle gets n w copies, rounded down or up") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::size_t n = 1 + seed % 40;
    const auto w = random_weights(n, seed);
    const auto count = copies(w, seed);
    REQUIRE(std::accumulate(count.begin(), count.end(), 0) == static_cast<int>(n));
    if (n == 1) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const double expected = static_cast<double>(n) * w[i];
      REQUIRE(count[i] >= std::floor(expected - 1e-9));
      REQUIRE(count[i] <= std::ceil(expected + 1e-9));
    }
  }
}

TEST_CASE("residual: each particle gets at least n w copies, rounded down, stratified fewer than two from n w") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::size_t n = 2 + seed % 40;
    const auto w = random_weights(n, seed);
    const auto residual = copies(w, seed, "resampling.residual"), stratified = copies(w, seed, "resampling.stratified");
    REQUIRE(std::accumulate(residual.begin(), residual.end(), 0) == static_cast<int>(n));
    for (std::size_t i = 0; i < n; ++i) {
      const double expected = static_cast<double>(n) * w[i];
      REQUIRE(residual[i] >= std::floor(expected - 1e-9));
      REQUIRE(std::abs(stratified[i] - expected) < 2);
    }
  }
}

TEST_CASE("over many seeds each particle gets n w copies on average, and independent draws scatter most") {
  const auto w = random_weights(10, 3);
  constexpr int runs = 4000;
  std::vector<double> scatter;
  for (const auto& module : kAll) {
    CAPTURE(module);
    std::vector<double> sum(w.size()), square(w.size());
    for (int s = 0; s < runs; ++s) {
      const auto count = copies(w, static_cast<std::uint64_t>(s), module);
      for (std::size_t i = 0; i < w.size(); ++i) {
        sum[i] += count[i];
        square[i] += count[i] * count[i];
      }
    }
    scatter.push_back(0);
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double mean = sum[i] / runs, variance = square[i] / runs - mean * mean;
      CHECK(std::abs(mean - 10 * w[i]) <= 4 * std::sqrt(variance / runs) + 2e-3);
      scatter.back() += variance;
      if (module == "resampling.multinomial")
        CHECK(variance == Approx(10 * w[i] * (1 - w[i])).epsilon(0.12).margin(2e-3));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) CHECK(scatter[k] < 0.8 * scatter[3]);
}

TEST_CASE("a particle without weight is never drawn, not even by rounding") {
  for (const auto& module : kAll) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const auto count = copies({0, 0.1, 0, 0.1, 0.7, 0.1, 0, 0}, seed, module);
      for (std::size_t dead : {0u, 2u, 6u, 7u}) REQUIRE(count[dead] == 0);
    }
    CHECK(copies({0, 0, 1, 0}, 5, module) == std::vector<int>{0, 0, 4, 0});
  }
}

TEST_CASE("weights far below the smallest double's exponent still resample by ratio") {
  ppm::Harness h(ppm::test::builtin(), "resampling.systematic", "{ess_below: 1}");
  h.belief().init(4, ppm::Pose::Identity(), nullptr);
  h.belief().log_weight = {-5000, -5000 + std::log(3.0), -9000, -9000};
  h.belief().normalize();
  auto& number = h.belief().column<int>("test/number");
  for (int i = 0; i < 4; ++i) number[static_cast<std::size_t>(i)] = i;
  h.tick();
  CHECK(number.values == std::vector<int>{0, 1, 1, 1});
}

TEST_CASE("resampling waits until the weights are uneven, and leaves equal ones") {
  ppm::Harness h(ppm::test::builtin(), "resampling.systematic", "{ess_below: 0.5}");
  auto& belief = h.belief();
  belief.init(4, ppm::Pose::Identity(), nullptr);
  belief.log_weight = {std::log(0.4), std::log(0.2), std::log(0.2), std::log(0.2)};
  const auto before = belief.log_weight;
  h.tick();
  CHECK(belief.log_weight == before);
  CHECK(last_metric(h, "resampled") == 0);
  CHECK(last_metric(h, "ancestors") == 4);
  CHECK(last_metric(h, "ess") == Approx(1 / (0.16 + 3 * 0.04)));

  belief.log_weight = {std::log(0.97), std::log(0.01), std::log(0.01), std::log(0.01)};
  h.tick();
  for (double w : belief.log_weight) CHECK(w == Approx(-std::log(4.0)));
  CHECK(last_metric(h, "resampled") == 1);
  CHECK(last_metric(h, "ancestors") <= 2);
  CHECK(last_metric(h, "ess") < 1.1);
}

TEST_CASE("one draw decides: the same seed gives the same particles, another seed others") {
  const auto w = random_weights(50, 11);
  CHECK(copies(w, 1) == copies(w, 1));
  int different = 0;
  for (std::uint64_t seed = 2; seed < 12; ++seed) different += copies(w, seed) != copies(w, 1);
  CHECK(different > 5);
}
