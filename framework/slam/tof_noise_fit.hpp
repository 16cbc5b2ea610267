#pragma once
#include <optional>
#include <vector>

#include "framework/slam/still_pixels.hpp"
#include "framework/slam/tof_noise.hpp"

namespace ppm {

/// Pixels that measured alike: similar range and, with amplitudes, similar amplitude.
struct NoiseBin {
  double range = 0;      ///< m, geometric mean
  double amplitude = 0;  ///< geometric mean; 0 without amplitudes
  double sigma = 0;      ///< m, standard deviation of one measurement; see noise_bins
  std::size_t pixels = 0;
};

/// Puts pixels into bins, 20 % of range by 30 % of amplitude wide, of at least 50 pixels. A bin's sigma comes from the
/// median of its pixels' variances, divided by that of a variance of Gaussian noise (chi^2 with images - 1 degrees of
/// freedom, Wilson & Hilferty's approximation: 0.4 % too large for four images), so that pixels at depth jumps or on
/// what moved do not count. use_amplitude: false bins by range alone. images: of each place.
std::vector<NoiseBin> noise_bins(const std::vector<StillPixel>& pixels, int images, bool use_amplitude);

/// Exponents that the data want, were they free: sigma^2 = floor^2 + (c range^p / amplitude^q)^2.
struct NoiseExponents {
  double range = 0, amplitude = 0;
};

struct TofNoiseFit {
  TofNoise noise;                      ///< floor, signal and quadratic are fitted, the rest is as given
  double log_rms = 0;                  ///< root mean square over the bins of log(measured / model), weighted by pixels
  std::optional<NoiseExponents> free;  ///< with amplitudes
};

/// Fits the model to bins: least squares of log sigma, weighted by pixels, with a Huber loss at 15 %. With amplitudes,
/// floor and signal come from bins of range and amplitude, and quadratic, with that floor, from bins of range alone;
/// without, floor and quadratic come from the latter and signal stays as in `start`. Bins
/// noisier than half of start.most are left out. Throws DataError where fewer than 6 remain.
TofNoiseFit fit_tof_noise(const std::vector<StillPixel>& pixels, int images, bool with_amplitude,
                          const TofNoise& start = {});

/// Shares of standardised deviations within 1, 2 and 3 standard deviations; Gaussian noise has .683, .954 and .997.
struct NoiseShares {
  double within_1 = 0, within_2 = 0, within_3 = 0;
  std::size_t deviations = 0;
};
/// A deviation is from the mean of the same `images` measurements, so its variance is (images - 1) / images of the
/// model's.
NoiseShares noise_shares(const std::vector<StillPixel>& pixels, int images, bool with_amplitude, const TofNoise& noise);

}  // namespace ppm
