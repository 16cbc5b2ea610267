#include "modules/weighting/range_kernels.hpp"

#include "framework/slam/pixel_block.hpp"

namespace ppm {

RangeArrays range_arrays(const PixelBlock& pixels) {
  const ViewSamples& expected = pixels.expected;
  return {pixels.range.data(),  pixels.variance.data(),   pixels.lateral.data(),  expected.range.data(),
          expected.variance.data(), expected.cosine.data(), pixels.size()};
}

}  // namespace ppm
