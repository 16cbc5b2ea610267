#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"
#include "modules/weighting/range_kernels.hpp"
#include "modules/weighting/range_mixture.hpp"

namespace {

using namespace ppm;

/// A likelihood for real frames: of each pixel the mixture of RangeMixture. Neighbouring pixels err together, so the sum
/// of the logs is scaled down (temper).
///
/// source  Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3 (beam model; exponent of the likelihood)
class RobustWeighting final : public Weighting {
 public:
  RobustWeighting() : Weighting(1200) {
    jump_m_ = 0.1;
    params_.add("temper", temper_)
        .range(0, 1)
        .above(0)
        .doc("Factor on the log likelihood: below 1 for pixels that err together.");
    range_.declare(params_);
    params_.add("depth_jump", jump_m_)
        .unit("m")
        .range(0, 10)
        .doc(
            "Pixels where the measured depth departs from a plane through its neighbours by more than this (and the "
            "noise) are left out; 0 keeps all.");
  }

 protected:
  ViewScore score(const PixelBlock& pixels) const override {
    ViewScore s = mixture_score(range_arrays(pixels), range_.terms());
    s.log_likelihood *= temper_;
    return s;
  }

 private:
  double temper_ = 0.03;
  RangeMixture range_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<RobustWeighting>("weighting.robust",
                         "Weighs particles by a tempered mixture that allows for outliers and misses.",
                         "Thrun, Burgard, Fox, Probabilistic Robotics, section 6.3; paper, section 4.2");
}
