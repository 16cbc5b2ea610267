#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace ppm {

/// Continuous ranked probability score of the forecast N(mean, variance) for what then came, where distances count
/// up to `limit`: E d(X, y) - E d(X, X') / 2 with d(a, b) = min(|a - b|, limit), X and X' from the forecast. Proper, as d
/// is conditionally negative definite (limit - d is a triangle, whose Fourier transform is nowhere negative). Between 0 and
/// `limit`; limit / 2 is a forecast that is spread so far that it says nothing.
/// off: y - mean; sigma > 0, both in the unit of `limit`.
/// Source: Gneiting & Raftery, JASA 102(477), 2007, sections 4.2 (normal) and 5.1 (kernel scores).
double truncated_crps(double off, double sigma, double limit);

/// How often errors lie within the central interval that a normal forecast gives a probability.
class CalibrationCurve {
 public:
  static constexpr std::size_t kSize = 20;
  /// The probabilities: 0.05, 0.1 ... 0.95, 0.99.
  static const std::array<double, kSize>& nominal();

  /// standardized: an error in standard deviations of its forecast.
  void add(double standardized);
  void add(const CalibrationCurve& other);
  /// Share of the errors that lie within each of the intervals; 0 where there are none.
  std::array<double, kSize> measured() const;

 private:
  std::array<std::size_t, kSize> first_within_{};  // errors that lie within this interval and not within the one before
  std::size_t errors_ = 0;
};

}  // namespace ppm
