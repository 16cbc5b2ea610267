#include <algorithm>
#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"
#include "modules/weighting/color_residuals.hpp"
#include "modules/weighting/range_gaussian.hpp"

namespace {

using namespace ppm;

/// The paper's likelihood with colour: to the product over pixels of N(range) comes N(channel; texel's mean, texel's
/// variance) for every channel of the texture. Pixels where the map shows nothing are skipped, as in the paper.
///
/// belief  needs a prediction with colour
/// throws  ConfigError where the map has no colour, DataError where the frame has none
/// source  paper, section 4.2
class GaussianColorWeighting final : public Weighting {
 public:
  GaussianColorWeighting() : Weighting(0) {
    range_.declare(params_);
    params_.add_choice("exposure", exposure_, {{"fixed", CompareColor::fixed}, {"gain", CompareColor::gain}})
        .doc(
            "Colours as they are, as in the paper, or divided by how much brighter the image is than the particle's "
            "view.");
  }

 protected:
  bool uses_color() const override { return true; }
  std::size_t block_size() const override { return exposure_ == CompareColor::gain ? kWholeView : kBlockSize; }
  ViewScore score(const PixelBlock& pixels) const override {
    const ColorResiduals color(pixels, exposure_);
    const double sensor = range_.of == RangeGaussian::Variance::texel_and_sensor ? color.sensor_variance() : 0.0;
    ViewScore s;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!pixels.hit(i)) {
        ++s.misses;
        continue;
      }
      const double r = pixels.residual(i), variance = range_.variance(pixels, i);
      s.log_likelihood += log_normal(r, variance);
      const double color_variance = std::max(pixels.expected.color_variance[i] + sensor, kLeastVariance);
      const ColorValue off = color.residual(i);
      for (std::size_t c = 0; c < color.channels(); ++c) s.log_likelihood += log_normal(off[c], color_variance);
      s.outliers += r * r > 9.0 * variance;
      s.residual_sum += std::abs(r);
      ++s.hits;
    }
    return s;
  }

 private:
  static constexpr double kLeastVariance = 1e-6;  // of a channel: cameras tell 256 steps
  RangeGaussian range_;
  CompareColor exposure_ = CompareColor::fixed;
};

}  // namespace

PPM_MODULES(r) {
  r.add<GaussianColorWeighting>("weighting.gaussian_color",
                                "Weighs particles by the product of Gaussians of all pixels' ranges and colours.",
                                "paper, section 4.2");
}
