#include "framework/graph/registry.hpp"
#include "framework/roles/resampler.hpp"

namespace {

using namespace ppm;

/// One uniform draw u_k in each n-th of [0, 1): ancestors at the points (k + u_k) / n. A particle's copies differ from
/// n w by less than two.
///
/// source  Kitagawa, "Monte Carlo filter and smoother", JCGS 1996
class Stratified final : public Resampler {
  std::vector<std::uint32_t> draw(std::span<const double> weights, std::size_t n, Rng rng) const override {
    std::vector<double> points(n);
    for (std::size_t k = 0; k < n; ++k) points[k] = (static_cast<double>(k) + rng.uniform()) / static_cast<double>(n);
    return particles_at(points, weights);
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<Stratified>("resampling.stratified", "Resamples by stratified draws when the effective sample size is low.",
                   "Kitagawa, \"Monte Carlo filter and smoother\", JCGS 1996; Douc, Cappe, Moulines, \"Comparison of resampling schemes for particle filtering\", ISPA 2005");
}
