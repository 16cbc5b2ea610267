#include "modules/weighting/range_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/weighting/range_kernels.hpp"

namespace ppm {

void RangeMixture::declare(Params& params) {
  params.add("outlier_share", outlier_share)
      .range(1e-9, 1)
      .doc("Prior probability that a pixel measures something else than the map's surface.");
  params.add("max_range", max_range).unit("m").range(1e-3, 1e6).doc("An outlier may lie anywhere up to here.");
  params.add("miss_density", miss_density)
      .above(0)
      .doc("Density, in 1/m, of any measured range where the map shows nothing.");
  params.add("model_sigma", model_sigma)
      .unit("m")
      .range(0, 1)
      .doc("Standard deviation of the map's surface, along the normal, beyond what its texels say.");
}

RangeMixture::Parts RangeMixture::parts(const PixelBlock& pixels, std::size_t i) const {
  const double inlier = (1 - outlier_share) / std::sqrt(2 * std::numbers::pi);
  const double r = pixels.residual(i), c2 = pixels.expected.cosine[i] * pixels.expected.cosine[i];
  const double lateral = pixels.lateral[i];
  const double variance = std::max(pixels.variance[i] + pixels.expected.variance[i] +
                                       (model_sigma * model_sigma + lateral * lateral * (1 - c2)) / c2,
                                   static_cast<double>(kLeastRangeVariance));
  return {inlier / std::sqrt(variance) * std::exp(-0.5 * r * r / variance), outlier_share / max_range};
}

}  // namespace ppm
