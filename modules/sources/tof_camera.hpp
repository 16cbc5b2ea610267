#pragma once
#include <cstdint>

#include "framework/slam/frame.hpp"
#include "modules/sources/analytic_scene.hpp"

namespace ppm {

/// A simulated time-of-flight camera like the SwissRanger SR4000.
/// It measures the phase of modulated light. A pixel's signal is the sum of what the surfaces inside it send back, each
/// with amplitude reflectance * cos(angle of incidence) / (range / 1 m)^2; at an edge the sum's phase lies between the
/// two ranges (a flying pixel). The range's standard deviation is noise * sqrt(floor^2 + (c / amplitude)^2); weak
/// signals and grazing views give no return.
/// Source: Lange & Seitz, "Solid-state time-of-flight range camera", IEEE JQE 37(3), 2001 (phase noise ~ 1 /
/// amplitude).
struct TofCamera {
  Camera camera{176, 144, 220, 220, 87.5, 71.5};  ///< 43.6 x 36.2 degrees
  double noise = 1;                               ///< scale of the range noise; 0 = exact ranges
  bool flying_pixels = true;                      ///< false: a pixel sees what its centre sees
  bool color = false;

  static constexpr double kFloor_m = 0.002, kSlope_m = 0.0003;  ///< of the noise
  static constexpr double kModulation_Hz = 15e6;                ///< ambiguous beyond 10 m
  static constexpr double kLeastAmplitude = 0.006;  ///< weaker signals are dropped (with 10 % noise on the amplitude)
  static constexpr double kLeastCosine = 0.1;       ///< more grazing views are dropped

  /// Standard deviation of the range, m, at least 0.1 mm.
  double range_sigma(double amplitude) const;

  /// Fills camera, depth, sigma (the true model's) and colour of a frame whose index is set. T_world_camera is the true
  /// pose. The noise is a function of (seed, frame.index, row): the same bytes in whatever order frames are made.
  void render(const AnalyticScene& scene, const Pose& T_world_camera, std::uint64_t seed, Frame& frame) const;
};

}  // namespace ppm
