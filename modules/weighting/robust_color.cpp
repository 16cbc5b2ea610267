#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"
#include "modules/weighting/color_residuals.hpp"
#include "modules/weighting/range_gaussian.hpp"
#include "modules/weighting/range_mixture.hpp"

namespace {

using namespace ppm;

/// weighting.robust with colour, by the chain rule: log p(range) + log p(colour | range) of each pixel, each sum with a
/// temper of its own, since colours of neighbouring pixels err together in other ways than their ranges do.
///
/// A pixel measures the map's surface or something else (RangeMixture). On the surface its colour is that of the map,
/// normal in every channel with the variances of texel, camera and model_color, or, with color_outlier_share, any
/// (highlights, shadows, patterns finer than texels). Of something else it may be any: density 1 over 0 .. 1. So a
/// pixel whose range disagrees says nothing by its colour. Where the map shows nothing, colour counts as any too.
///
/// belief  needs a prediction with colour
/// throws  ConfigError where the map has no colour, DataError where the frame has none
/// source  paper, section 4.2; Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3
class RobustColorWeighting final : public Weighting {
 public:
  RobustColorWeighting() : Weighting(1200) {
    jump_m_ = 0.1;
    params_.add("temper", temper_)
        .range(0, 1)
        .above(0)
        .doc("Factor on the log likelihood of ranges: below 1 for pixels that err together.");
    range_.declare(params_);
    params_.add("depth_jump", jump_m_)
        .unit("m")
        .range(0, 10)
        .doc(
            "Pixels where the measured depth departs from a plane through its neighbours by more than this (and the "
            "noise) are left out; 0 keeps all.");
    params_.add("color_temper", color_temper_)
        .range(0, 1)
        .doc("Factor on the log likelihood of colours given ranges; 0 is weighting.robust.");
    params_.add("color_outlier_share", color_outlier_share_)
        .range(0, 1)
        .above(0)
        .doc("Prior probability that a pixel on the map's surface has another colour than the map says.");
    params_.add("model_color", model_color_)
        .range(0, 1)
        .doc("Standard deviation of a channel beyond what texels and camera say, where 1 is the brightest.");
    params_.add_choice("exposure", exposure_, {{"gain", CompareColor::gain}, {"fixed", CompareColor::fixed}})
        .doc(
            "Colours divided by how much brighter the image is than the particle's view (automatic exposure), or as "
            "they are.");
  }

 protected:
  bool uses_color() const override { return true; }
  std::size_t block_size() const override { return exposure_ == CompareColor::gain ? kWholeView : kBlockSize; }
  ViewScore score(const PixelBlock& pixels) const override {
    const ColorResiduals color(pixels, exposure_);
    const double log_miss = std::log(range_.miss_density);
    double ranges = 0, colors = 0;
    ViewScore s;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!pixels.hit(i)) {
        ++s.misses;
        ranges += log_miss;
        continue;
      }
      const auto density = range_.parts(pixels, i);
      ranges += std::log(density.sum());
      colors += std::log((density.surface * on_surface(color, pixels, i) + density.outlier) /
                         density.sum());
      s.outliers += density.outlier > density.surface;
      s.residual_sum += std::abs(pixels.residual(i));
      ++s.hits;
    }
    s.log_likelihood = temper_ * ranges + color_temper_ * colors;
    return s;
  }

 private:
  /// Density of a colour measured on the map's surface.
  double on_surface(const ColorResiduals& color, const PixelBlock& pixels, std::size_t i) const {
    const double variance = pixels.expected.color_variance[i] + color.sensor_variance() + model_color_ * model_color_;
    const ColorValue off = color.residual(i);
    double log_density = 0;
    for (std::size_t c = 0; c < color.channels(); ++c) log_density += log_normal(off[c], variance);
    return (1 - color_outlier_share_) * std::exp(log_density) + color_outlier_share_;
  }

  double temper_ = 0.03, color_temper_ = 0.03, color_outlier_share_ = 0.1, model_color_ = 0.03;
  RangeMixture range_;
  CompareColor exposure_ = CompareColor::gain;
};

}  // namespace

PPM_MODULES(r) {
  r.add<RobustColorWeighting>(
      "weighting.robust_color",
      "Weighs particles by tempered mixtures of ranges and colours that allow for outliers, misses and exposure.",
      "paper, section 4.2; Thrun, Burgard, Fox, Probabilistic Robotics, section 6.3");
}
