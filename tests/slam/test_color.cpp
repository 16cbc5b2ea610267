#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/slam/color.hpp"
#include "framework/slam/color_score.hpp"

using namespace ppm;

namespace {

/// A row of pixels at 2 m with the given intensities, 0 .. 255.
Frame row_of(const std::vector<std::uint8_t>& intensity) {
  Frame f;
  f.camera = {static_cast<int>(intensity.size()), 1, 1e6, 1e6, 0, 0};
  f.depth.assign(intensity.size(), 2.0f);
  f.sigma.assign(intensity.size(), 0.01f);
  f.color_sigma = 0.02f;
  for (auto value : intensity) f.color.insert(f.color.end(), 3, value);
  return f;
}

Prediction gray(const Frame& frame, const std::vector<float>& intensity, float variance) {
  Prediction p;
  p.reset(frame.camera, 1, Pose::Identity(), 1);
  for (std::size_t i = 0; i < intensity.size(); ++i) {
    p.range[i] = 2;
    p.chunk[i] = 0;
    p.color[i] = intensity[i];
    p.color_variance[i] = variance;
  }
  return p;
}

double log_mixture(double x, double variance) {
  return std::log(0.95 * std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance) + 0.05);
}

}  // namespace

TEST_CASE("the colour of a pixel: its channels, or their luma") {
  Frame f = row_of({0, 0});
  f.color = {1, 2, 3, 255, 102, 51};
  CHECK(color_of(f, 1, 3)[0] == Approx(1));
  CHECK(color_of(f, 1, 3)[1] == Approx(0.4));
  CHECK(color_of(f, 1, 3)[2] == Approx(0.2));
  CHECK(color_of(f, 1, 1)[0] == Approx(0.299 + 0.587 * 0.4 + 0.114 * 0.2));
}

TEST_CASE("the gain is the median ratio of each channel, dark and saturated values apart, drawn to 1 by few") {
  ColorGain gain(3);
  for (int i = 0; i < 1000; ++i) {
    const float base = 0.2f + 0.0004f * static_cast<float>(i);
    gain.add({1.3f * base, i < 300 ? 0.9f : 0.8f * base, 0.99f}, {base, base, 0.5f});  // 30 % of green is something else
    gain.add({0.01f, 0.01f, 0.01f}, {0.5f, 0.5f, 0.5f});
  }
  const ColorValue g = gain.estimate();
  CHECK(g[0] == Approx(1.3).epsilon(0.01));
  CHECK(g[1] == Approx(0.8).epsilon(0.02));
  CHECK(g[2] == 1.0f);
  ColorGain few(1);
  for (int i = 0; i < 20; ++i) few.add({0.4f, 0, 0}, {0.2f, 0, 0});
  CHECK(few.estimate()[0] == Approx(std::sqrt(2.0)));
  CHECK(ColorGain(1).estimate()[0] == 1.0f);
}

TEST_CASE("colour score of three pixels, by hand") {
  const Frame frame = row_of({51, 102, 255});  // 0.2, 0.4, 1
  const float v = 0.0004f;
  // Ratios 0.2/0.2, 0.4/0.36, and a saturated one that does not count: the gain is that of the larger, drawn to 1.
  const Prediction p = gray(frame, {0.2f, 0.36f, 0.3f}, v);
  ColorScorer scorer;
  scorer.add(frame, p, 1);
  const auto s = scorer.score();
  const double gain = std::pow(0.4 / 0.36, 2.0 / 22.0), variance = v + std::pow(0.02 / gain, 2);
  const double off[3] = {0.2 / gain - 0.2, 0.4 / gain - 0.36, 1 / gain - 0.3};
  CHECK(s.pixels == 3);
  CHECK(s.channels == 1);
  CHECK(s.rms_as_is == Approx(std::sqrt((0.04 * 0.04 + 0.49) / 3)).epsilon(1e-4));
  CHECK(s.rms == Approx(std::sqrt((off[0] * off[0] + off[1] * off[1] + off[2] * off[2]) / 3)).epsilon(1e-4));
  CHECK(s.median == Approx(off[1]).epsilon(1e-3));
  double log_density = 0;
  for (double x : off) log_density += log_mixture(x, variance) / 3;
  CHECK(s.log_density == Approx(log_density).epsilon(1e-4));
  CHECK(s.outliers == Approx(1.0 / 3));
  CHECK(s.within_1_sigma == 0.5);
  CHECK(s.within_2_sigma == 1);
}

TEST_CASE("pixels without a return or a prediction do not count for colour, and none at all is an error") {
  Frame frame = row_of({51, 51, 51});
  frame.depth[0] = NAN;
  Prediction p = gray(frame, {0.2f, 0.2f, 0.2f}, 1e-4f);
  p.chunk[1] = Prediction::kNone;
  ColorScorer scorer;
  CHECK(scorer.empty());
  CHECK_THROWS_AS(scorer.score(), DataError);
  scorer.add(frame, p, 1);
  CHECK(scorer.score().pixels == 1);
}
