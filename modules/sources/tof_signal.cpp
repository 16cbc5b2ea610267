#include "modules/sources/tof_signal.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>

namespace ppm {
namespace {

constexpr double kLightSpeed = 299792458;
constexpr double kPhasePerMetre = 4 * EIGEN_PI * TofSignal::kModulation_Hz / kLightSpeed;

}  // namespace

TofEcho TofSignal::echo(double reflectance, double cosine, double range_m) {
  return {range_m, reflectance * cosine / (range_m * range_m), cosine};
}

TofEcho TofSignal::mixed(std::span<const TofEcho> parts) {
  std::complex<double> phasor = 0;
  double amplitudes = 0;
  TofEcho sum;
  for (const TofEcho& e : parts) {
    phasor += std::polar(e.amplitude, e.range_m * kPhasePerMetre);
    amplitudes += e.amplitude;
    sum.cosine += e.amplitude * e.cosine;
  }
  if (amplitudes == 0) return sum;
  sum.cosine /= amplitudes;
  sum.amplitude = std::abs(phasor) / static_cast<double>(parts.size());
  sum.range_m = std::arg(phasor) / kPhasePerMetre;
  if (sum.range_m < 0) sum.range_m += 2 * EIGEN_PI / kPhasePerMetre;
  return sum;
}

double TofSignal::range_sigma(double amplitude) const {
  return std::max(1e-4, noise * std::hypot(kFloor_m, kSlope_m / amplitude));
}

std::optional<TofSignal::Reading> TofSignal::read(const TofEcho& e, Rng& rng) const {
  const double range_noise = rng.normal(), amplitude_noise = rng.normal();
  if (e.cosine < kLeastCosine || e.amplitude * (1 + 0.1 * noise * amplitude_noise) < kLeastAmplitude) return std::nullopt;
  const double sigma = range_sigma(e.amplitude);
  return Reading{e.range_m + (noise > 0 ? sigma * range_noise : 0.0), sigma};
}

}  // namespace ppm
