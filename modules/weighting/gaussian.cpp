#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"
#include "modules/weighting/range_gaussian.hpp"
#include "modules/weighting/range_kernels.hpp"

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
    range_.declare(params_);
  }

 protected:
  ViewScore score(const PixelBlock& pixels) const override {
    return gaussian_score(range_arrays(pixels), range_.of == RangeGaussian::Variance::texel_and_sensor);
  }

 private:
  RangeGaussian range_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<GaussianWeighting>("weighting.gaussian", "Weighs particles by the product of Gaussians of all pixels.",
                           "paper, section 4.2");
}
