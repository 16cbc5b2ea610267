#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/normal_score.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// How well a map predicts depth that it has not seen, over the valid measured pixels of held-out frames.
/// A pixel where the map predicts nothing counts as an infinite error: in the median, in the shares, and as 20 cm in the
/// truncated mean.
struct DepthScore {
  std::size_t pixels = 0;  ///< valid measured pixels
  double coverage = 0;     ///< share of them where the map predicts something
  double median_mm = 0;    ///< absolute error along the ray
  double within_1cm = 0, within_2cm = 0, within_5cm = 0;
  double mean_trunc20cm_mm = 0;
  double log_density = 0;  ///< mean log predictive density of the range, 1/m; see DepthScorer
  double outliers = 0;     ///< share of the pixels where something is predicted that the uniform part explains better
  /// Shares of the others whose error is within one and two predicted standard deviations: 0.683 and 0.954 of a normal
  /// distribution.
  double within_1_sigma = 0, within_2_sigma = 0;
  /// Shares of the others whose error is within the central interval of each CalibrationCurve::nominal().
  std::array<double, CalibrationCurve::kSize> calibration{};
  /// Mean over all pixels of truncated_crps() of the normal part, distances up to 20 cm; 100 mm, a forecast that says
  /// nothing, where nothing is predicted.
  double crps_mm = 0;
};

/// Collects errors over frames. The predictive density of a pixel is 0.95 N(measured; expected range, variance along the
/// ray of map and sensor) + 0.05 U(0, 10 m); U alone at a miss: one wrong pixel cannot outweigh all others.
class DepthScorer {
 public:
  /// frame: the held-out image; prediction: of the same camera, same pose; pixels (x, y) with x % step == y % step == step/2
  /// of the frame's own grid are compared. The prediction's camera is the frame's decimated so (see sampling_camera).
  void add(const Frame& frame, const Prediction& prediction, int step);
  /// Adds what another one has collected.
  void add(const DepthScorer& other);
  bool empty() const { return errors_m_.empty(); }
  /// Throws DataError where it is empty.
  DepthScore score() const;
  /// The camera whose pixels are exactly the compared ones.
  static Camera sampling_camera(const Camera& camera, int step) { return camera.decimated(step, step / 2, step / 2); }

 private:
  std::vector<double> errors_m_;
  double log_density_sum_ = 0, crps_sum_m_ = 0;
  std::size_t covered_ = 0, inliers_ = 0, within_1_sigma_ = 0, within_2_sigma_ = 0;
  CalibrationCurve calibration_;
};

}  // namespace ppm
