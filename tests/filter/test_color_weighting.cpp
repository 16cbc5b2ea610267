#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

const Camera kTiny{3, 2, 1e4, 1e4, 1, 0.5};  // all rays along the optical axis

/// A wall at 2 m; colours by pixel, three channels each.
std::shared_ptr<Frame> frame_of(const Camera& camera, const std::vector<std::uint8_t>& color) {
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  frame->depth.assign(static_cast<std::size_t>(camera.pixels()), 2.0f);
  frame->sigma.assign(static_cast<std::size_t>(camera.pixels()), 0.01f);
  frame->lateral_px = 0;
  frame->color_sigma = 0.02f;
  frame->color = color;
  return frame;
}

std::shared_ptr<Prediction> view_of(const Camera& camera, float depth, int channels, const std::vector<float>& color,
                                    float color_variance) {
  auto p = std::make_shared<Prediction>();
  p->reset(camera, 1, Pose::Identity(), channels);
  for (std::size_t i = 0; i < p->range.size(); ++i) {
    p->range[i] = depth;
    p->variance[i] = 1e-4f;
    p->normal[3 * i + 2] = -1;
    p->chunk[i] = p->face[i] = 0;
    if (channels > 0) p->color_variance[i] = color_variance;
  }
  p->color = color;
  return p;
}

double log_odds(const std::string& module, const std::string& params, std::shared_ptr<const Frame> frame,
                std::shared_ptr<const Prediction> a, std::shared_ptr<const Prediction> b) {
  Harness h(test::builtin(), module, params);
  h.belief().init(2, a->T_map_camera, nullptr);
  h.belief().prediction = {a, b};
  h.input<Frame>("frame", frame);
  h.tick();
  return h.belief().log_weight[0] - h.belief().log_weight[1];
}

double log_normal(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(2 * std::numbers::pi * variance));
}

std::vector<std::uint8_t> ramp() {
  std::vector<std::uint8_t> color;
  for (int i = 0; i < 18; ++i) color.push_back(static_cast<std::uint8_t>(60 + 9 * i));
  return color;
}

/// The frame's colours times `scale` plus an error for each value.
std::vector<float> expected(double scale, double error) {
  std::vector<float> color;
  for (int i = 0; i < 18; ++i)
    color.push_back(static_cast<float>(scale * ramp()[static_cast<std::size_t>(i)] / 255.0 + error * ((i * 7) % 5 - 2)));
  return color;
}

}  // namespace

TEST_CASE("weighting.gaussian_color is the product of the Gaussians of range and channels") {
  const auto frame = frame_of(kTiny, ramp());
  const auto a = view_of(kTiny, 2.01f, 3, expected(1, 0.01), 9e-4f), b = view_of(kTiny, 2.0f, 3, expected(1, 0.03), 4e-4f);
  const bool sensor = GENERATE(false, true);
  double odds = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const double s = sensor ? 1e-4 : 0;
    odds += log_normal(0.01, 1e-4 + s) - log_normal(0, 1e-4 + s);
  }
  for (std::size_t i = 0; i < 18; ++i) {
    const double measured = ramp()[i] / 255.0, s = sensor ? 4e-4 : 0;
    odds += log_normal(measured - a->color[i], 9e-4 + s) - log_normal(measured - b->color[i], 4e-4 + s);
  }
  const std::string params = sensor ? "{variance: texel_and_sensor}" : "{}";
  CHECK(log_odds("weighting.gaussian_color", params, frame, a, b) == Approx(odds).epsilon(2e-3));
}

TEST_CASE("weighting.robust_color is the tempered mixture of ranges, and of colours given ranges") {
  const auto frame = frame_of(kTiny, ramp());
  const auto a = view_of(kTiny, 2.01f, 3, expected(1, 0.01), 9e-4f), b = view_of(kTiny, 2.05f, 3, expected(1, 0.04), 4e-4f);
  auto log_likelihood = [&](const Prediction& p, double off) {
    const double variance = 1e-4 + 1e-4 + 25e-6, surface = 0.9 * std::exp(log_normal(off, variance)), other = 0.1 / 10;
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      double color = 1;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
        color *= std::exp(log_normal(ramp()[c] / 255.0 - p.color[c], p.color_variance[i] + 4e-4 + 0.0025));
      sum += 0.5 * std::log(surface + other);
      sum += 0.25 * std::log((surface * (0.8 * color + 0.2) + other) / (surface + other));
    }
    return sum;
  };
  const std::string params =
      "{pixels: 0, depth_jump: 0, temper: 0.5, color_temper: 0.25, color_outlier_share: 0.2, model_color: 0.05, "
      "exposure: fixed}";
  CHECK(log_odds("weighting.robust_color", params, frame, a, b) ==
        Approx(log_likelihood(*a, -0.01) - log_likelihood(*b, -0.05)).epsilon(2e-3));
}

TEST_CASE("a view of the right colours wins over one of the right shape alone, and without a temper for colour it does not") {
  const auto frame = frame_of(kTiny, ramp());
  const auto right = view_of(kTiny, 2.0f, 3, expected(1, 0), 4e-4f), wrong = view_of(kTiny, 2.0f, 3, expected(1, 0.1), 4e-4f);
  CHECK(log_odds("weighting.gaussian_color", "{}", frame, right, wrong) > 10);
  CHECK(log_odds("weighting.robust_color", "{pixels: 0}", frame, right, wrong) > 0.1);
  CHECK(log_odds("weighting.robust_color", "{pixels: 0, color_temper: 0}", frame, right, wrong) ==
        Approx(0.0).margin(1e-9));
  CHECK(log_odds("weighting.robust_color", "{pixels: 0, color_temper: 0, model_sigma: 1 cm}", frame, right, wrong) ==
        Approx(log_odds("weighting.robust", "{pixels: 0, model_sigma: 1 cm}", frame, right, wrong)).margin(1e-6));
}

TEST_CASE("a change of exposure does not decide between views, when it is asked for") {
  const Camera camera{40, 30, 1e4, 1e4, 19.5, 14.5};
  std::vector<std::uint8_t> bright;
  std::vector<float> same, other;
  for (int i = 0; i < camera.pixels(); ++i) {
    const double value = 0.2 + 0.4 * ((i * 37) % 101) / 100.0;
    for (int c = 0; c < 3; ++c) bright.push_back(static_cast<std::uint8_t>(std::lround(1.25 * value * 255)));
    same.push_back(static_cast<float>(value));
    other.push_back(static_cast<float>(1.25 * value + 0.12 * ((i % 2) - 0.5)));  // as bright as the image, but noisy
  }
  const auto frame = frame_of(camera, bright);
  const auto right = view_of(camera, 2.0f, 1, same, 4e-4f), wrong = view_of(camera, 2.0f, 1, other, 4e-4f);
  const std::string module = GENERATE("weighting.gaussian_color", "weighting.robust_color");
  CHECK(log_odds(module, "{exposure: gain}", frame, right, wrong) > 0);
  CHECK(log_odds(module, "{exposure: fixed}", frame, right, wrong) < 0);
}

TEST_CASE("colour cannot be weighed where the map or the frame has none") {
  const std::string module = GENERATE("weighting.gaussian_color", "weighting.robust_color");
  const auto colored = view_of(kTiny, 2.0f, 3, expected(1, 0), 4e-4f), plain = view_of(kTiny, 2.0f, 0, {}, 0);
  CHECK_THROWS_WITH(log_odds(module, "{}", frame_of(kTiny, ramp()), plain, plain), Catch::Contains("set `color`"));
  CHECK_THROWS_WITH(log_odds(module, "{}", frame_of(kTiny, {}), colored, colored), Catch::Contains("`color: true`"));
}

TEST_CASE("the gain is that of the whole view") {
  const Camera camera{60, 40, 1e5, 1e5, 29.5, 19.5};
  const auto n = static_cast<std::size_t>(camera.pixels());
  const auto frame = frame_of(camera, std::vector<std::uint8_t>(3 * n, 128));
  std::vector<float> right(3 * n, 128 / 255.f), darker_above = right;
  std::fill_n(darker_above.begin(), 3 * 1100, 100 / 255.f);  // less than half of the pixels: the median is 1
  const std::string module = GENERATE("weighting.gaussian_color", "weighting.robust_color");
  const double odds = log_odds(module, "{exposure: gain}", frame, view_of(camera, 2.0f, 3, right, 4e-4f),
                               view_of(camera, 2.0f, 3, darker_above, 4e-4f));
  CHECK(odds > 10);
}
