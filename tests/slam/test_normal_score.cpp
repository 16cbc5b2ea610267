#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/core/rng.hpp"
#include "framework/slam/normal_score.hpp"

using ppm::truncated_crps;

TEST_CASE("far below the limit the score is the continuous ranked probability score of a normal distribution") {
  // Gneiting & Raftery 2007, equation 21.
  for (double off : {0.0, 0.01, -0.03})
    for (double sigma : {0.001, 0.01, 0.02}) {
      const double z = off / sigma, density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
      const double crps =
          sigma * (z * std::erf(z / std::numbers::sqrt2) + 2 * density - 1 / std::sqrt(std::numbers::pi));
      CHECK(truncated_crps(off, sigma, 10.0) == Approx(crps).epsilon(1e-9));
    }
}

TEST_CASE("the ends of the score: sure and right, sure and far off, nothing said") {
  CHECK(truncated_crps(0, 1e-6, 0.2) < 1e-6);
  CHECK(truncated_crps(3, 1e-6, 0.2) == Approx(0.2));
  CHECK(truncated_crps(0.05, 1e-6, 0.2) == Approx(0.05).epsilon(1e-4));
  for (double off : {0.0, 0.3, 3.0}) CHECK(truncated_crps(off, 1e4, 0.2) == Approx(0.1).epsilon(1e-3));
}

TEST_CASE("the score is the mean truncated distance less half that between two draws") {
  const double off = 0.04, sigma = 0.15, limit = 0.2;
  ppm::Rng rng(1, 0, 0, 0);
  double sum = 0;
  const int n = 400000;
  for (int i = 0; i < n; ++i) {
    const double a = sigma * rng.normal(), b = sigma * rng.normal();
    sum += std::min(std::abs(a - off), limit) - 0.5 * std::min(std::abs(a - b), limit);
  }
  CHECK(truncated_crps(off, sigma, limit) == Approx(sum / n).margin(5e-4));
}

TEST_CASE("the score is proper: in the mean the true variance and mean win") {
  const double sigma = 0.08, limit = 0.2;
  auto expected = [&](double shift, double claimed) {  // over what comes from N(0, sigma^2)
    double sum = 0, weights = 0;
    for (double y = -6 * sigma; y <= 6 * sigma; y += sigma / 50) {
      const double weight = std::exp(-0.5 * y * y / (sigma * sigma));
      sum += weight * truncated_crps(y - shift, claimed, limit);
      weights += weight;
    }
    return sum / weights;
  };
  const double honest = expected(0, sigma);
  for (double factor : {0.25, 0.8, 1.25, 4.0, 100.0}) CHECK(expected(0, factor * sigma) > honest);
  for (double shift : {-0.02, 0.05}) CHECK(expected(shift, sigma) > honest);
}

TEST_CASE("errors of the forecast's own distribution make the calibration curve a diagonal") {
  ppm::CalibrationCurve one, other;
  ppm::Rng rng(2, 0, 0, 0);
  for (int i = 0; i < 100000; ++i) (i % 3 ? one : other).add(rng.normal());
  one.add(other);
  const auto& nominal = ppm::CalibrationCurve::nominal();
  const auto measured = one.measured();
  CHECK(nominal.front() == 0.05);
  CHECK(nominal[9] == 0.5);
  CHECK(nominal.back() == 0.99);
  for (std::size_t i = 0; i < nominal.size(); ++i) CHECK(measured[i] == Approx(nominal[i]).margin(0.005));
  CHECK(ppm::CalibrationCurve().measured().back() == 0);
}
