#pragma once
#include <algorithm>
#include <cmath>

namespace ppm {

/// Noise of the range of a time-of-flight camera. It measures a phase, whose noise is the inverse of the light that
/// comes back; a floor stays however much that is.
///   with amplitude     sigma^2 = floor^2 + (signal / light)^2, where light = amplitude / range^2 or the amplitude
///   itself without amplitude  sigma^2 = floor^2 + (quadratic * range^2)^2, that of a surface of ordinary brightness
/// both at most `most`: a phase that is all noise is somewhere within the unambiguous range.
/// Source: Lange & Seitz, "Solid-state time-of-flight range camera", IEEE JQE 37(3), 2001 (noise against amplitude).
/// The numbers are fitted to still images of an SR4000 (docs/results/tof_noise.md).
struct TofNoise {
  double floor = 0.0118;  ///< m
  double signal = 3.26;   ///< m times the amplitude's unit, per m^2 where amplitudes are range_corrected
  bool range_corrected =
      true;                   ///< the camera has multiplied its amplitudes by the square of the range (the SR4000 does)
  double quadratic = 0.0096;  ///< 1/m
  double most = 1.0;          ///< m

  /// Standard deviation of a range, m. range: m along the ray, > 0; amplitude >= 0.
  double sigma(double range, double amplitude) const {
    return amplitude > 0 ? with_floor(signal * (range_corrected ? range * range : 1) / amplitude) : most;
  }
  double sigma(double range) const { return with_floor(quadratic * range * range); }

 private:
  double with_floor(double s) const { return std::min(most, std::sqrt(floor * floor + s * s)); }
};

}  // namespace ppm
