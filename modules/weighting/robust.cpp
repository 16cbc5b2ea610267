#include <cmath>
#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"

namespace {

using namespace ppm;

/// A likelihood for real frames. Each pixel is a mixture: the map's surface, with everything that blurs it along the
/// ray, or something else, anywhere up to max_range. A pixel where the map shows nothing has a density of its own.
/// Neighbouring pixels err together, so the sum of the logs is scaled down (temper).
///
/// Variance along the ray, with c = |normal . ray|:
///   sensor + (texel + model_sigma^2 + lateral^2 (1 - c^2)) / c^2
/// lateral is the frame's standard deviation across the ray.
///
/// source  Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3 (hit and random parts of the beam model;
///         exponent of the likelihood)
class RobustWeighting final : public Weighting {
 public:
  RobustWeighting() : Weighting(1200) {
    jump_m_ = 0.1;
    params_.add("temper", temper_)
        .range(0, 1)
        .above(0)
        .doc("Factor on the log likelihood: below 1 for pixels that err together.");
    params_.add("outlier_share", outlier_share_)
        .range(0, 1)
        .above(0)
        .doc("Prior probability that a pixel measures something else than the map's surface.");
    params_.add("max_range", max_range_).unit("m").above(0).doc("An outlier may lie anywhere up to here.");
    params_.add("miss_density", miss_density_)
        .above(0)
        .doc("Density, in 1/m, of any measured range where the map shows nothing.");
    params_.add("model_sigma", model_sigma_)
        .unit("m")
        .range(0, 1)
        .doc("Standard deviation of the map's surface, along the normal, beyond what its texels say.");
    params_.add("depth_jump", jump_m_)
        .unit("m")
        .range(0, 10)
        .doc(
            "Pixels where the measured depth departs from a plane through its neighbours by more than this (and the "
            "noise) are left out; 0 keeps all.");
  }

 protected:
  ViewScore score(const MeasuredPixels& measured, const RangeResiduals& residuals) const override {
    const double inlier = (1 - outlier_share_) / std::sqrt(2 * std::numbers::pi), outlier = outlier_share_ / max_range_;
    const double log_miss = std::log(miss_density_);
    double sum = 0;
    ViewScore s;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (residuals.residual[i] == Prediction::kMiss) {
        ++s.misses;
        sum += log_miss;
        continue;
      }
      const double r = residuals.residual[i], c2 = residuals.cosine[i] * residuals.cosine[i];
      const double lateral = measured.lateral[i];
      const double variance = measured.variance[i] + residuals.map_variance[i] +
                              (model_sigma_ * model_sigma_ + lateral * lateral * (1 - c2)) / c2;
      const double surface = inlier / std::sqrt(variance) * std::exp(-0.5 * r * r / variance);
      sum += std::log(surface + outlier);
      s.outliers += outlier > surface;
      s.residual_sum += std::abs(r);
      ++s.hits;
    }
    s.log_likelihood = temper_ * sum;
    return s;
  }

 private:
  double temper_ = 0.03, outlier_share_ = 0.1, max_range_ = 10.0, miss_density_ = 0.1, model_sigma_ = 0.005;
};

}  // namespace

PPM_MODULES(r) {
  r.add<RobustWeighting>("weighting.robust",
                         "Weighs particles by a tempered mixture that allows for outliers and misses.",
                         "Thrun, Burgard, Fox, Probabilistic Robotics, section 6.3; paper, section 4.2");
}
