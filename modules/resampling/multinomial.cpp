#include "framework/graph/registry.hpp"
#include "framework/roles/resampler.hpp"

namespace {

using namespace ppm;

/// n independent draws: the bootstrap filter's own form, and the one with the largest variance.
///
/// source  Gordon, Salmond, Smith, "Novel approach to nonlinear/non-Gaussian Bayesian state estimation", 1993
class Multinomial final : public Resampler {
  std::vector<std::uint32_t> draw(std::span<const double> weights, std::size_t n, Rng rng) const override {
    return particles_at(sorted_uniforms(n, rng), weights);
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<Multinomial>("resampling.multinomial", "Resamples by independent draws when the effective sample size is low.",
                    "Gordon, Salmond, Smith, \"Novel approach to nonlinear/non-Gaussian Bayesian state estimation\", IEE Proceedings F 1993");
}
