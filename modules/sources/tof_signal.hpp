#pragma once
#include <optional>
#include <span>

#include "framework/core/rng.hpp"

namespace ppm {

/// What a surface sends back to a time-of-flight camera.
struct TofEcho {
  double range_m = 0, amplitude = 0;
  double cosine = 0;  ///< of the angle of incidence
};

/// What a time-of-flight camera like the SwissRanger SR4000 makes of the light of a pixel.
/// It measures the phase of modulated light. A pixel's signal is the sum of what the surfaces inside it send back, each
/// with amplitude reflectance * cos(angle of incidence) / (range / 1 m)^2; at an edge the sum's phase lies between the
/// two ranges (a flying pixel). The range's standard deviation is noise * sqrt(floor^2 + (c / amplitude)^2); weak
/// signals and grazing views give no return.
/// Source: Lange & Seitz, "Solid-state time-of-flight range camera", IEEE JQE 37(3), 2001 (phase noise ~ 1 /
/// amplitude).
struct TofSignal {
  double noise = 1;           ///< scale of the range noise; 0 = exact ranges
  bool flying_pixels = true;  ///< false: a pixel sees what its centre sees

  static constexpr double kFloor_m = 0.002, kSlope_m = 0.0003;  ///< of the noise
  static constexpr double kModulation_Hz = 15e6;                ///< ambiguous beyond 10 m
  static constexpr double kLeastAmplitude = 0.006;  ///< weaker signals are dropped (with 10 % noise on the amplitude)
  static constexpr double kLeastCosine = 0.1;       ///< more grazing views are dropped
  static constexpr double kEdge_m = 0.02;           ///< a jump in range that makes an edge

  /// The echo of one surface, of the share of light that it reflects.
  static TofEcho echo(double reflectance, double cosine, double range_m);
  /// The phasor sum of the echoes of a pixel's parts, divided by their number. The amplitude is 0 where none has any.
  static TofEcho mixed(std::span<const TofEcho> parts);

  /// Standard deviation of the range, m, at least 0.1 mm.
  double range_sigma(double amplitude) const;

  struct Reading {
    double range_m, sigma_m;
  };
  /// What the camera reads; nothing where the signal is too weak or too grazing. Draws two numbers, whatever comes out.
  std::optional<Reading> read(const TofEcho& echo, Rng& rng) const;
};

}  // namespace ppm
