#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {
namespace {

/// Ancestors by one uniform draw u in [0, 1): particle j is taken once for each of the points (k + u) / n, k = 0 ..
/// n-1, that falls into its part of the cumulated weights. Its number of copies is n w_j rounded down or up, n w_j on
/// average.
std::vector<std::uint32_t> systematic_ancestors(const std::vector<double>& log_weight, double u) {
  const auto n = log_weight.size();
  std::vector<double> below(n);  // cumulated weight up to and with j
  double sum = 0;
  std::uint32_t last = 0;  // of those with a weight: rounding must not hand a point to one without
  for (std::size_t j = 0; j < n; ++j) {
    const double w = std::exp(log_weight[j]);
    if (w > 0) last = static_cast<std::uint32_t>(j);
    sum += w;
    below[j] = sum;
  }
  std::vector<std::uint32_t> ancestors(n);
  std::uint32_t j = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double point = (static_cast<double>(k) + u) / static_cast<double>(n) * sum;
    while (j < last && below[j] <= point) ++j;
    ancestors[k] = j;
  }
  return ancestors;
}

/// Replaces the particles by n draws from themselves where the weights have become uneven; log weights become -log n.
/// belief   needs normalised weights; every column moves
/// metrics  ess: effective sample size before; resampled: 1 or 0; ancestors: distinct particles that live on
class Systematic final : public Module {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};

  Systematic() {
    params_.add("ess_below", ess_below_)
        .range(0, 1)
        .doc(
            "Resamples when the effective sample size is below this share of the particles; 1 resamples unless all "
            "weights "
            "are equal, 0 never.");
  }

  void tick(Context& context) override {
    auto& particles = *belief;
    const auto n = particles.size();
    const double ess = particles.ess();
    const bool resample = ess < ess_below_ * static_cast<double>(n);
    std::size_t distinct = n;
    if (resample) {
      const auto ancestors = systematic_ancestors(particles.log_weight, context.rng("resample").uniform());
      distinct = 1;
      for (std::size_t k = 1; k < n; ++k) distinct += ancestors[k] != ancestors[k - 1];  // they ascend
      particles.gather(ancestors);
      std::fill(particles.log_weight.begin(), particles.log_weight.end(), -std::log(static_cast<double>(n)));
    }
    context.metric("ess", ess);
    context.metric("resampled", resample ? 1 : 0);
    context.metric("ancestors", static_cast<double>(distinct));
  }

 private:
  double ess_below_ = 0.5;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::Systematic>(
      "resampling.systematic", "Resamples by systematic draws when the effective sample size is low.",
      "Kitagawa, \"Monte Carlo filter and smoother\", JCGS 1996; Doucet, Johansen 2011, section 3.4");
}
