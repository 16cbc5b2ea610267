#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "framework/slam/tof_noise_fit.hpp"
#include "tests/support/plane_image.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr int kImages = 4;
const TofNoise kTrue{.floor = 0.02, .signal = 8, .quadratic = 0.012};

/// A still camera's images of a floor that gets darker to the right; every 50th pixel is at an edge, and jumps.
std::vector<Frame> still(const TofNoise& noise, bool amplitudes, std::uint32_t place) {
  const Camera camera{176, 144, 220, 220, 87.5, 71.5};
  const Frame truth = plane_image(camera, {0, 0.75, 0.45}, 1.2 + 0.1 * place);
  std::vector<Frame> frames;
  for (std::uint32_t k = 0; k < kImages; ++k) {
    Frame f = truth;
    f.index = k;
    Rng rng(1, k, place, 0);
    for (int i = 0; i < camera.pixels(); ++i) {
      const auto p = static_cast<std::size_t>(i);
      const double length = camera.ray(i % 176, i / 176).norm(), range = truth.depth[p] * length;
      const double amplitude = 3000 * std::exp(-0.015 * (i % 176));
      if (amplitudes) f.confidence.push_back(static_cast<float>(amplitude));
      const double sigma = amplitudes ? noise.sigma(range, amplitude) : noise.sigma(range);
      f.depth[p] += static_cast<float>(sigma * rng.normal() / length + (i % 50 == 0 && k % 2 == 0 ? 0.5 : 0));
      if (!(f.depth[p] > 0.3 && f.depth[p] < 8)) f.depth[p] = kNoReturn;
    }
    frames.push_back(std::move(f));
  }
  return frames;
}

}  // namespace

TEST_CASE("still pixels: mean and unbiased variance of the range along the ray, of pixels that always return") {
  const Camera camera{3, 1, 1, 1, 1, 0};
  std::vector<Frame> frames(3, plane_image(camera, {0, 0, 1}, 2));
  frames[1].depth = {2, 2.3f, kNoReturn};
  for (auto& f : frames) f.confidence = {10, 20, 30};
  const auto pixels = still_pixels(frames, 5);
  REQUIRE(pixels.size() == 2);
  CHECK(pixels[0].range == Approx(2 * std::sqrt(2.0)));
  CHECK(pixels[0].variance == 0);
  CHECK(pixels[1].group == 5);
  CHECK(pixels[1].amplitude == 20);
  CHECK(pixels[1].range == Approx(2.1));
  CHECK(pixels[1].variance == Approx((0.01 + 0.04 + 0.01) / 2));
  CHECK(pixels[1].deviation[1] == Approx(0.2));
}

TEST_CASE("still images that do not go together are refused") {
  std::vector<Frame> frames(2, plane_image({3, 1, 1, 1, 1, 0}, {0, 0, 1}, 2));
  frames[1].confidence = {1, 1, 1};
  CHECK_THROWS_AS(still_pixels(frames, 0), DataError);
  frames[1] = plane_image({3, 1, 2, 2, 1, 0}, {0, 0, 1}, 2);
  CHECK_THROWS_AS(still_pixels(frames, 0), DataError);
  CHECK_THROWS_AS(still_pixels({frames[0]}, 0), InternalError);
}

TEST_CASE("the fit finds the noise that was put in, in spite of outliers") {
  for (const bool amplitudes : {true, false}) {
    CAPTURE(amplitudes);
    std::vector<StillPixel> pixels;
    for (std::uint32_t place = 0; place < 3; ++place) {
      const auto more = still_pixels(still(kTrue, amplitudes, place), static_cast<int>(place));
      pixels.insert(pixels.end(), more.begin(), more.end());
    }
    const auto fit = fit_tof_noise(pixels, kImages, amplitudes);
    CHECK(fit.noise.floor == Approx(kTrue.floor).epsilon(0.1));
    CHECK(fit.log_rms < 0.06);
    CHECK(fit.free.has_value() == amplitudes);
    if (amplitudes) {
      CHECK(fit.noise.signal == Approx(kTrue.signal).epsilon(0.05));
      CHECK(fit.free->range == Approx(2).epsilon(0.05));
      CHECK(fit.free->amplitude == Approx(1).epsilon(0.05));
    } else {
      CHECK(fit.noise.quadratic == Approx(kTrue.quadratic).epsilon(0.05));
    }
    const auto shares = noise_shares(pixels, kImages, amplitudes, fit.noise);
    CHECK(shares.deviations == kImages * pixels.size());
    CHECK(shares.within_1 == Approx(0.98 * 0.683).margin(0.02));
    CHECK(shares.within_2 == Approx(0.98 * 0.954).margin(0.02));
    CHECK(shares.within_3 == Approx(0.98 * 0.997).margin(0.015));
  }
}

TEST_CASE("too little to fit is refused, with the reason") {
  const auto pixels = still_pixels(still(kTrue, true, 0), 0);
  CHECK_THROWS_AS(fit_tof_noise({pixels.begin(), pixels.begin() + 200}, kImages, true), DataError);
  CHECK(noise_shares({}, kImages, true, kTrue).deviations == 0);
}
