#include "framework/slam/normal_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ppm {

namespace {

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

/// E max(X, 0) of X from N(mean, sigma^2).
double mean_positive_part(double mean, double sigma) {
  const double z = mean / sigma;
  return sigma * std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi) + mean * normal_cdf(z);
}

/// E min(|X|, limit) of X from N(mean, sigma^2).
double mean_truncated_size(double mean, double sigma, double limit) {
  return mean_positive_part(mean, sigma) - mean_positive_part(mean - limit, sigma) +  //
         mean_positive_part(-mean, sigma) - mean_positive_part(-mean - limit, sigma);
}

/// The z with P(|N(0, 1)| <= z) = probability, by bisection.
double half_width(double probability) {
  double low = 0, high = 10;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (std::erf(z / std::numbers::sqrt2) < probability ? low : high) = z;
  }
  return 0.5 * (low + high);
}

using Curve = std::array<double, CalibrationCurve::kSize>;

Curve half_widths() {
  Curve out{};
  std::ranges::transform(CalibrationCurve::nominal(), out.begin(), half_width);
  return out;
}

}  // namespace

double truncated_crps(double off, double sigma, double limit) {
  return mean_truncated_size(off, sigma, limit) - 0.5 * mean_truncated_size(0, std::numbers::sqrt2 * sigma, limit);
}

const Curve& CalibrationCurve::nominal() {
  static const Curve probabilities = [] {
    Curve out{};
    for (std::size_t i = 0; i + 1 < kSize; ++i) out[i] = static_cast<double>(i + 1) / 20;
    out.back() = 0.99;
    return out;
  }();
  return probabilities;
}

void CalibrationCurve::add(double standardized) {
  static const Curve widths = half_widths();
  ++errors_;
  const auto interval = std::ranges::lower_bound(widths, std::abs(standardized));
  if (interval != widths.end()) ++first_within_[static_cast<std::size_t>(interval - widths.begin())];
}

void CalibrationCurve::add(const CalibrationCurve& other) {
  errors_ += other.errors_;
  for (std::size_t i = 0; i < kSize; ++i) first_within_[i] += other.first_within_[i];
}

Curve CalibrationCurve::measured() const {
  Curve out{};
  if (errors_ == 0) return out;
  std::size_t within = 0;
  for (std::size_t i = 0; i < kSize; ++i) {
    within += first_within_[i];
    out[i] = static_cast<double>(within) / static_cast<double>(errors_);
  }
  return out;
}

}  // namespace ppm
