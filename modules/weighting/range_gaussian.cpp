#include "modules/weighting/range_gaussian.hpp"

#include <algorithm>

#include "modules/weighting/range_kernels.hpp"

namespace ppm {

void RangeGaussian::declare(Params& params) {
  params.add_choice("variance", of, {{"texel", Variance::texel}, {"texel_and_sensor", Variance::texel_and_sensor}})
      .doc("Variance of a pixel: the texel's alone, as in the paper, or the predictive one, with the sensor's added.");
}

double RangeGaussian::variance(const PixelBlock& pixels, std::size_t i) const {
  const double sensor = of == Variance::texel_and_sensor ? pixels.variance[i] : 0.0;
  return std::max(pixels.expected.variance[i] + sensor, static_cast<double>(kLeastRangeVariance));
}

}  // namespace ppm
