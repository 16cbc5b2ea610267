#include "framework/slam/depth_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"

namespace ppm {

namespace {

constexpr double kInlier = 0.95;       // weight of the map's own density
constexpr double kUniform = 1.0 / 10;  // 1/m, of a map that knows nothing
constexpr double kTruncation = 0.20;   // m

double normal_density(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance);
}

}  // namespace

void DepthScorer::add(const Frame& frame, const Prediction& prediction, int step) {
  PPM_CHECK(prediction.camera == sampling_camera(frame.camera, step), "the prediction is not of the sampled pixels");
  for (int y = 0, i = 0; y < prediction.camera.rows; ++y) {
    for (int x = 0; x < prediction.camera.cols; ++x, ++i) {
      const int pixel = (step / 2 + step * y) * frame.camera.cols + step / 2 + step * x;
      if (!frame.valid(pixel)) continue;
      const auto p = static_cast<std::size_t>(pixel), k = static_cast<std::size_t>(i);
      if (!prediction.hit(k)) {
        errors_m_.push_back(std::numeric_limits<double>::infinity());
        log_density_sum_ += std::log(kUniform);
        crps_sum_m_ += kTruncation / 2;
        continue;
      }
      const double range_per_depth = prediction.camera.ray(x, y).norm();
      const auto direction = prediction.direction(k);
      const double off = frame.depth[p] * range_per_depth - prediction.expected_range(k, direction);
      const double sensor_sigma = frame.sigma[p] * range_per_depth;
      const double variance = prediction.range_variance(k, direction) + sensor_sigma * sensor_sigma;
      errors_m_.push_back(std::abs(off));
      const double normal = kInlier * normal_density(off, variance), uniform = (1 - kInlier) * kUniform;
      log_density_sum_ += std::log(normal + uniform);
      crps_sum_m_ += truncated_crps(off, std::sqrt(variance), kTruncation);
      ++covered_;
      if (normal < uniform) continue;
      ++inliers_;
      within_1_sigma_ += off * off <= variance;
      within_2_sigma_ += off * off <= 4 * variance;
      calibration_.add(off / std::sqrt(variance));
    }
  }
}

void DepthScorer::add(const DepthScorer& other) {
  errors_m_.insert(errors_m_.end(), other.errors_m_.begin(), other.errors_m_.end());
  log_density_sum_ += other.log_density_sum_;
  crps_sum_m_ += other.crps_sum_m_;
  covered_ += other.covered_;
  inliers_ += other.inliers_;
  within_1_sigma_ += other.within_1_sigma_;
  within_2_sigma_ += other.within_2_sigma_;
  calibration_.add(other.calibration_);
}

DepthScore DepthScorer::score() const {
  if (errors_m_.empty()) throw DataError("the held-out frames", "hold no valid measured pixel to compare");
  const auto n = static_cast<double>(errors_m_.size());
  auto within = [&](double limit_m) {
    const auto good = std::ranges::count_if(errors_m_, [=](double e) { return e <= limit_m; });
    return static_cast<double>(good) / n;
  };
  double truncated = 0;
  for (double e : errors_m_) truncated += std::min(e, kTruncation);
  DepthScore out;
  out.pixels = errors_m_.size();
  out.coverage = static_cast<double>(covered_) / n;
  out.median_mm = 1e3 * quantile(errors_m_, 0.5);
  out.within_1cm = within(0.01);
  out.within_2cm = within(0.02);
  out.within_5cm = within(0.05);
  out.mean_trunc20cm_mm = 1e3 * truncated / n;
  out.log_density = log_density_sum_ / n;
  auto share = [](std::size_t part, std::size_t all) {
    return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
  };
  out.outliers = share(covered_ - inliers_, covered_);
  out.within_1_sigma = share(within_1_sigma_, inliers_);
  out.within_2_sigma = share(within_2_sigma_, inliers_);
  out.calibration = calibration_.measured();
  out.crps_mm = 1e3 * crps_sum_m_ / n;
  return out;
}

}  // namespace ppm
