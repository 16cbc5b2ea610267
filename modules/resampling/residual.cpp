#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/graph/registry.hpp"
#include "framework/roles/resampler.hpp"

namespace {

using namespace ppm;

/// Each particle gets n w copies, rounded down; the rest is drawn independently by what rounding took away.
///
/// source  Liu, Chen, "Sequential Monte Carlo methods for dynamic systems", JASA 1998
class Residual final : public Resampler {
  std::vector<std::uint32_t> draw(std::span<const double> weights, std::size_t n, Rng rng) const override {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::uint32_t> ancestors;
    std::vector<double> rest(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double wanted = static_cast<double>(n) * weights[i] / sum;
      // n w is whole for equal weights, but its rounding may lie below.
      const double copies = std::min(std::floor(wanted + 1e-9), static_cast<double>(n - ancestors.size()));
      ancestors.insert(ancestors.end(), static_cast<std::size_t>(copies), static_cast<std::uint32_t>(i));
      rest[i] = std::max(wanted - copies, 0.0);
    }
    if (ancestors.size() < n) {
      const auto drawn = particles_at(sorted_uniforms(n - ancestors.size(), rng), rest);
      ancestors.insert(ancestors.end(), drawn.begin(), drawn.end());
      std::ranges::sort(ancestors);
    }
    return ancestors;
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<Residual>("resampling.residual", "Resamples by residual draws when the effective sample size is low.",
                 "Liu, Chen, \"Sequential Monte Carlo methods for dynamic systems\", JASA 1998");
}
