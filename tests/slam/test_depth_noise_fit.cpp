#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "framework/slam/depth_noise_fit.hpp"

using namespace ppm;

namespace {

const DepthNoise kTrue{.floor = 0.002, .quadratic = 0.003, .near = 0.5, .lateral_px = 0.8};

/// Residuals of that noise beside a map that errs by 3 mm itself; some are of other surfaces.
std::vector<DepthResidual> simulated(int count, double outliers) {
  std::vector<DepthResidual> out;
  Rng rng(1, 0, 0, 0);
  for (int i = 0; i < count; ++i) {
    DepthResidual r;
    r.depth_m = 0.5 + 3.5 * rng.uniform();
    r.map_variance = 9e-6;
    r.sigma_m = 0.02;
    r.slope_m_px = r.depth_m / 300 * 4 * rng.uniform();
    const double sigma = std::sqrt(kTrue.variance(r) + r.map_variance);
    r.off_m = rng.uniform() < outliers ? 4 * rng.uniform() - 2 : sigma * rng.normal();
    out.push_back(r);
  }
  return out;
}

}  // namespace

TEST_CASE("noise is found from residuals, the map's own variance taken off, outliers set aside") {
  const auto residuals = simulated(20000, 0.05);
  const auto fit = fit_depth_noise(residuals);
  for (double z : {0.7, 1.5, 2.5, 3.5}) {
    const DepthResidual head_on{.depth_m = z}, slanted{.depth_m = z, .slope_m_px = z / 100};
    CHECK(fit.noise.variance(head_on) == Approx(kTrue.variance(head_on)).epsilon(0.15));
    CHECK(fit.noise.variance(slanted) == Approx(kTrue.variance(slanted)).epsilon(0.1));
  }
  CHECK(fit.noise.lateral_px == Approx(0.8).margin(0.05));
  CHECK(fit.outliers == Approx(0.05).margin(0.01));
  const auto before = noise_quality(residuals), after = noise_quality(residuals, &fit.noise);
  CHECK(after.log_density > before.log_density + 0.1);
  CHECK(after.within_1_sigma == Approx(0.683).margin(0.015));
  CHECK(after.within_2_sigma == Approx(0.954).margin(0.01));
}

TEST_CASE("a noise fit refuses few residuals") {
  CHECK_THROWS_AS(fit_depth_noise(simulated(100, 0)), DataError);
}
