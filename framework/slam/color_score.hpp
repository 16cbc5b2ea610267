#pragma once
#include <cstddef>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// How well a map with colour predicts the colours of held-out frames, over the measured pixels where it predicts
/// something. Colours are 0 .. 1; numbers are means over pixels and channels.
struct ColorScore {
  std::size_t pixels = 0;
  int channels = 0;
  double rms_as_is = 0;    ///< root mean square of measured minus predicted colour
  double rms = 0;          ///< the same after each frame was divided by its gain (see ColorGain), as are all below
  double median = 0;       ///< of the absolute error
  double log_density = 0;  ///< mean log predictive density of a channel; 0 is a map that knows nothing
  double outliers = 0;     ///< share of values that the uniform part of that density explains better
  /// Shares of the others that are within one and two predicted standard deviations.
  double within_1_sigma = 0, within_2_sigma = 0;
};

/// Collects errors over frames. The predictive density of a channel is 0.95 N(measured; predicted, variance of map and
/// camera) + 0.05 U(0, 1).
class ColorScorer {
 public:
  /// Arguments as of DepthScorer::add; frame and prediction must have colour.
  void add(const Frame& frame, const Prediction& prediction, int step);
  bool empty() const { return errors_.empty(); }
  /// Throws DataError where no pixel was compared.
  ColorScore score() const;

 private:
  int channels_ = 0;
  std::vector<double> errors_;  // absolute, gain removed
  double squares_as_is_ = 0, squares_ = 0, log_density_sum_ = 0;
  std::size_t inliers_ = 0, within_1_sigma_ = 0, within_2_sigma_ = 0;
};

}  // namespace ppm
