#pragma once
#include <cstddef>
#include <vector>

namespace ppm {

/// A measured depth beside what a map predicts of it, along the optical axis.
struct DepthResidual {
  double depth_m = 0;       ///< measured
  double off_m = 0;         ///< measured less predicted
  double map_variance = 0;  ///< m^2, of the prediction by the map alone
  double sigma_m = 0;       ///< of the measurement, as the graph's noise model has it
  double slope_m_px = 0;    ///< m of depth that a shift across the line of sight by one pixel makes on this surface
};

/// Noise of a depth, the model of FrameConditioning, and across the line of sight.
struct DepthNoise {
  double floor = 0.0012, quadratic = 0.0019, near = 0.4, lateral_px = 0.5;
  /// m^2, of a residual by the sensor alone.
  double variance(const DepthResidual& r) const;
};

/// How well residuals are described. The density is 0.95 N + 0.05 U(0, 10 m), as in DepthScorer.
struct NoiseQuality {
  double log_density = 0;                        ///< mean, 1/m
  double within_1_sigma = 0, within_2_sigma = 0;  ///< shares, of the residuals that the Gaussian explains better
};

struct DepthNoiseFit {
  DepthNoise noise;
  double outliers = 0;  ///< share of the residuals that the uniform part explains
};

/// Maximum likelihood of residuals under (1 - outliers) N(0, map + sensor) + outliers U(0, 10 m), by expectation maximisation
/// with Fisher scoring for the sensor's variance. What else is in the residuals, error of poses above all, counts as the sensor's.
/// Throws DataError where there are fewer than 500 residuals.
/// Source: Dempster, Laird, Rubin, "Maximum likelihood from incomplete data via the EM algorithm", JRSS B 1977.
DepthNoiseFit fit_depth_noise(const std::vector<DepthResidual>& residuals, const DepthNoise& start = {});

/// With the noise that the graph has (sigma_m), or with a fitted one.
NoiseQuality noise_quality(const std::vector<DepthResidual>& residuals, const DepthNoise* noise = nullptr);

}  // namespace ppm
