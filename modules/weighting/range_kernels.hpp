#pragma once
#include <cstddef>

#include "framework/slam/view_score.hpp"

namespace ppm {

struct PixelBlock;

/// m^2: a map may be certain, but not beyond 10 micrometres.
inline constexpr float kLeastRangeVariance = 1e-10f;

/// The arrays of a PixelBlock that likelihoods of ranges read, each [size].
struct RangeArrays {
  const float *range, *variance, *lateral;                       // measured: m, m^2, m
  const float *expected_range, *expected_variance, *cosine;      // of the view: m, m^2, 1
  std::size_t size;
};

RangeArrays range_arrays(const PixelBlock& pixels);

/// What the densities of RangeMixture have in common over all pixels.
struct MixtureTerms {
  double outlier_density;  ///< 1/m, times its prior probability
  double miss_density;     ///< 1/m
  double inlier_share;     ///< prior probability of the map's surface
  double model_variance;   ///< m^2 along the normal
};

/// Log likelihood of a block by RangeGaussian. sensor_variance: whether the sensor's variance is added to the map's.
/// No number where a hit's range or variance is none.
///
/// Both kernels work in float on 16 lanes, whatever the processor: pixel i belongs to lane i % 16, and lanes are added
/// up in double, in order. So the bytes depend on the order of the pixels alone. Factors are multiplied, mantissas and
/// exponents apart, before one logarithm is taken for eight lanes. Against sums in double the error is below 1e-6 a
/// pixel. Blocks of any size; one far above 1,000 pixels loses accuracy.
ViewScore gaussian_score(const RangeArrays& pixels, bool sensor_variance);

/// Log likelihood of a block by RangeMixture, without its temper.
ViewScore mixture_score(const RangeArrays& pixels, const MixtureTerms& terms);

}  // namespace ppm
