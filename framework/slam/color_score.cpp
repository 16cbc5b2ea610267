#include "framework/slam/color_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"
#include "framework/slam/color.hpp"
#include "framework/slam/depth_score.hpp"

namespace ppm {

namespace {

constexpr double kInlier = 0.95;  // weight of the map's own density; the rest is uniform over 0 .. 1

/// A compared pixel.
struct Pair {
  ColorValue measured, expected{};
  double map_variance;
};

std::vector<Pair> pairs_of(const Frame& frame, const Prediction& prediction, int step) {
  std::vector<Pair> pairs;
  const int channels = prediction.color_channels;
  for (int y = 0, i = 0; y < prediction.camera.rows; ++y)
    for (int x = 0; x < prediction.camera.cols; ++x, ++i) {
      const int pixel = (step / 2 + step * y) * frame.camera.cols + step / 2 + step * x;
      const auto k = static_cast<std::size_t>(i);
      if (!frame.valid(pixel) || !prediction.hit(k)) continue;
      Pair pair{color_of(frame, static_cast<std::size_t>(pixel), channels), {}, prediction.color_variance[k]};
      std::copy_n(&prediction.color[k * static_cast<std::size_t>(channels)], channels, pair.expected.begin());
      pairs.push_back(pair);
    }
  return pairs;
}

}  // namespace

void ColorScorer::add(const Frame& frame, const Prediction& prediction, int step) {
  PPM_CHECK(prediction.camera == DepthScorer::sampling_camera(frame.camera, step),
            "the prediction is not of the sampled pixels");
  PPM_CHECK(prediction.color_channels > 0 && !frame.color.empty(), "frame {} or its prediction has no colour",
            frame.index);
  channels_ = prediction.color_channels;
  const auto pairs = pairs_of(frame, prediction, step);
  ColorGain comparison(channels_);
  for (const auto& p : pairs) comparison.add(p.measured, p.expected);
  const ColorValue gain = comparison.estimate();
  for (const auto& p : pairs)
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
      const double as_is = p.measured[c] - p.expected[c], off = p.measured[c] / gain[c] - p.expected[c];
      const double sensor = frame.color_sigma / gain[c], variance = p.map_variance + sensor * sensor;
      squares_as_is_ += as_is * as_is;
      squares_ += off * off;
      errors_.push_back(std::abs(off));
      const double normal =
          kInlier * std::exp(-0.5 * off * off / variance) / std::sqrt(2 * std::numbers::pi * variance);
      log_density_sum_ += std::log(normal + (1 - kInlier));
      if (normal < 1 - kInlier) continue;
      ++inliers_;
      within_1_sigma_ += off * off <= variance;
      within_2_sigma_ += off * off <= 4 * variance;
    }
}

ColorScore ColorScorer::score() const {
  if (errors_.empty()) throw DataError("the held-out frames", "hold no measured pixel whose colour the map predicts");
  const auto n = static_cast<double>(errors_.size()), inliers = static_cast<double>(std::max<std::size_t>(inliers_, 1));
  ColorScore s;
  s.channels = channels_;
  s.pixels = errors_.size() / static_cast<std::size_t>(channels_);
  s.rms_as_is = std::sqrt(squares_as_is_ / n);
  s.rms = std::sqrt(squares_ / n);
  s.median = quantile(errors_, 0.5);
  s.log_density = log_density_sum_ / n;
  s.outliers = 1 - static_cast<double>(inliers_) / n;
  s.within_1_sigma = static_cast<double>(within_1_sigma_) / inliers;
  s.within_2_sigma = static_cast<double>(within_2_sigma_) / inliers;
  return s;
}

}  // namespace ppm
