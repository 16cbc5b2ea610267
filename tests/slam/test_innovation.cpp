#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/rng.hpp"
#include "framework/slam/innovation.hpp"

using namespace ppm;

namespace {

constexpr float kSensor = 0.003f, kMap = 0.004f, kLateral = 0.002f, kCosine = 0.6f;

/// Measurements that depart from what is expected by `scale` times the noise that is claimed, and by `bias` of it.
Innovation innovation_of(double scale, double bias, std::size_t outliers, std::size_t pixels = 16000) {
  Rng rng(1, 0, 0, 0);
  Frame frame;
  MeasuredPixels measured;
  ViewSamples expected;
  expected.resize(pixels);
  const double across = kLateral * kLateral * (1 - kCosine * kCosine) / (kCosine * kCosine);
  const double sigma = std::sqrt(kSensor * kSensor + kMap * kMap + across);
  for (std::size_t i = 0; i < pixels; ++i) {
    expected.range[i] = i % 10 == 3 ? Prediction::kMiss : 2.0f;
    expected.variance[i] = kMap * kMap;
    expected.cosine[i] = kCosine;
    measured.pixel.push_back(0);
    measured.source.push_back(0);
    measured.range.push_back(static_cast<float>(2 + sigma * (bias + scale * rng.normal()) + (i < outliers ? 0.5 : 0)));
    measured.variance.push_back(kSensor * kSensor);
    measured.lateral.push_back(kLateral);
  }
  Innovation innovation;
  innovation.add(PixelBlock(frame, measured, 0, expected));
  return innovation;
}

}  // namespace

TEST_CASE("normalised residuals have variance 1 where the noise is as claimed") {
  const auto right = innovation_of(1, 0, 0);
  CHECK(right.count == Approx(16000 / Innovation::kEvery * 0.9).epsilon(0.15));
  CHECK(right.mean() == Approx(0).margin(0.07));
  CHECK(right.variance() == Approx(1).epsilon(0.1));
  CHECK(innovation_of(2, 0, 0).variance() > 3);
  CHECK(innovation_of(0.5, 0, 0).variance() == Approx(0.25).epsilon(0.1));
  CHECK(innovation_of(1, 1, 0).mean() == Approx(1).epsilon(0.1));
}

TEST_CASE("other surfaces are not part of the innovation, nor is nothing") {
  const auto some = innovation_of(1, 0, 4000);
  CHECK(some.variance() == Approx(1).epsilon(0.15));
  CHECK(some.count < innovation_of(1, 0, 0).count);
  const Innovation none;
  CHECK(none.mean() == 0);
  CHECK(none.variance() == 0);
}
