#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"

namespace {

using namespace ppm;

/// The paper's likelihood: the product over pixels of N(measured - expected range; variance), where the texel's mean
/// and variance are carried from the normal to the ray. Pixels where the map shows nothing are skipped, as in the
/// paper: a particle that looks away from its map loses nothing by it.
///
/// source  paper, section 4.2
class GaussianWeighting final : public Weighting {
 public:
  GaussianWeighting() : Weighting(0) {
    params_
        .add_choice("variance", variance_,
                    {{"texel", Variance::texel}, {"texel_and_sensor", Variance::texel_and_sensor}})
        .doc(
            "Variance of a pixel: the texel's alone, as in the paper, or the predictive one, with the sensor's added.");
  }

 protected:
  ViewScore score(const MeasuredPixels& measured, const RangeResiduals& residuals) const override {
    const double sensor_share = variance_ == Variance::texel_and_sensor ? 1.0 : 0.0;
    ViewScore s;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const double r = residuals.residual[i];
      if (residuals.residual[i] == Prediction::kMiss) {
        ++s.misses;
        continue;
      }
      const double variance = std::max(residuals.map_variance[i] + sensor_share * measured.variance[i], kMinVariance);
      const double square = r * r / variance;
      s.log_likelihood -= 0.5 * (square + std::log(2 * std::numbers::pi * variance));
      s.outliers += square > 9.0;
      s.residual_sum += std::abs(r);
      ++s.hits;
    }
    return s;
  }

 private:
  static constexpr double kMinVariance = 1e-10;  // m^2: a map may be certain, but not beyond 10 micrometres
  enum class Variance { texel, texel_and_sensor } variance_ = Variance::texel;
};

}  // namespace

PPM_MODULES(r) {
  r.add<GaussianWeighting>("weighting.gaussian", "Weighs particles by the product of Gaussians of all pixels.",
                           "paper, section 4.2");
}
