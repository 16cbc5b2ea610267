#include "framework/roles/resampler.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {

std::vector<std::uint32_t> particles_at(std::span<const double> points, std::span<const double> weights) {
  std::vector<double> below(weights.size());  // cumulated weight up to and with j
  double sum = 0;
  std::uint32_t last = 0;  // of those with a weight
  for (std::size_t j = 0; j < weights.size(); ++j) {
    if (weights[j] > 0) last = static_cast<std::uint32_t>(j);
    sum += weights[j];
    below[j] = sum;
  }
  std::vector<std::uint32_t> particles;
  particles.reserve(points.size());
  std::uint32_t j = 0;
  for (double point : points) {
    while (j < last && below[j] <= point * sum) ++j;
    particles.push_back(j);
  }
  return particles;
}

std::vector<double> sorted_uniforms(std::size_t n, Rng& rng) {
  // Arrivals of a Poisson process, given that the (n+1)-th comes at 1.
  std::vector<double> points(n);
  double time = 0;
  for (auto& point : points) point = time -= std::log1p(-rng.uniform());
  time -= std::log1p(-rng.uniform());
  for (auto& point : points) point = time > 0 ? std::min(point / time, std::nextafter(1.0, 0.0)) : 0.0;
  return points;
}

Resampler::Resampler() {
  params_.add("ess_below", ess_below_)
      .range(0, 1)
      .doc(
          "Resamples when the effective sample size is below this share of the particles; 1 resamples unless all "
          "weights are equal, 0 only where another number of particles is wanted.");
  number_.declare(params_);
}

void Resampler::tick(Context& context) {
  auto& particles = *belief;
  const auto before = particles.size();
  const double ess = particles.ess();
  std::vector<double> weights(before);
  std::ranges::transform(particles.log_weight, weights.begin(), [](double l) { return std::exp(l); });
  const auto n = number_.wanted(particles, weights, context.rng("number"));
  const bool resample = ess < ess_below_ * static_cast<double>(before) || n != before;
  std::size_t distinct = before;
  if (resample) {
    const auto ancestors = draw(weights, n, context.rng("resample"));
    PPM_CHECK(ancestors.size() == n && std::ranges::is_sorted(ancestors), "{} ancestors of {} particles", ancestors.size(), n);
    distinct = 1;
    for (std::size_t k = 1; k < n; ++k) distinct += ancestors[k] != ancestors[k - 1];
    particles.gather(ancestors);
    std::fill(particles.log_weight.begin(), particles.log_weight.end(), -std::log(static_cast<double>(n)));
  }
  context.metric("ess", ess);
  context.metric("resampled", resample ? 1 : 0);
  context.metric("ancestors", static_cast<double>(distinct));
  context.metric("particles", static_cast<double>(before));
  context.metric("drawn", static_cast<double>(n));
}

}  // namespace ppm
