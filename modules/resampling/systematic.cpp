#include "framework/graph/registry.hpp"
#include "framework/roles/resampler.hpp"

namespace {

using namespace ppm;

/// One uniform draw u in [0, 1): ancestors at the points (k + u) / n. A particle gets n w copies, rounded down or up.
///
/// source  Kitagawa, "Monte Carlo filter and smoother", JCGS 1996
class Systematic final : public Resampler {
  std::vector<std::uint32_t> draw(std::span<const double> weights, std::size_t n, Rng rng) const override {
    const double u = rng.uniform();
    std::vector<double> points(n);
    for (std::size_t k = 0; k < n; ++k) points[k] = (static_cast<double>(k) + u) / static_cast<double>(n);
    return particles_at(points, weights);
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<Systematic>("resampling.systematic", "Resamples by systematic draws when the effective sample size is low.",
                   "Kitagawa, \"Monte Carlo filter and smoother\", JCGS 1996; Doucet, Johansen 2011, section 3.4");
}
