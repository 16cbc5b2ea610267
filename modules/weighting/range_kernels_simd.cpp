#include "modules/weighting/range_kernels.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/weighting/range_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PPM_RANGE_KERNELS_ONCE
#define PPM_RANGE_KERNELS_ONCE
namespace ppm {
namespace {

constexpr std::size_t kLanes = 16;

// What each lane has gathered so far.
struct LaneSums {
  LaneSums() {
    for (float& m : mantissa) m = 1;
  }
  alignas(64) float mantissa[kLanes];  // product of the factors' mantissas, each in [1, 2)
  alignas(64) std::int32_t exponent[kLanes] = {};  // sum of the factors' exponents, biased
  alignas(64) float quadratic[kLanes] = {};        // sum of r^2 / variance
  alignas(64) float residual[kLanes] = {};         // sum of |r|, m
  alignas(64) float witness[kLanes] = {};  // sum of what must be finite for the likelihood to be a number
  std::int64_t groups = 0;                         // factors of each lane
  std::size_t hits = 0, outliers = 0;
};

// The last pixels of a block, filled up to one group with misses.
struct Tail {
  explicit Tail(const RangeArrays& all) : done(all.size / kLanes * kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      values[0][i] = values[2][i] = values[4][i] = 0;
      values[1][i] = values[5][i] = 1;
      values[3][i] = std::numeric_limits<float>::infinity();
    }
    const float* from[] = {all.range, all.variance, all.lateral, all.expected_range, all.expected_variance, all.cosine};
    for (std::size_t k = 0; k < 6; ++k)
      std::memcpy(values[k], from[k] + done, (all.size - done) * sizeof(float));
  }
  RangeArrays arrays() const { return {values[0], values[1], values[2], values[3], values[4], values[5], kLanes}; }
  std::size_t done;
  alignas(64) float values[6][kLanes];
};

double log_product(const LaneSums& sums) {
  double log = 0;
  std::int64_t exponent = -127 * sums.groups * static_cast<std::int64_t>(kLanes);
  for (std::size_t first = 0; first < kLanes; first += 8) {
    double product = 1;  // at most 8 * 66 powers of two
    for (std::size_t i = first; i < first + 8; ++i) product *= static_cast<double>(sums.mantissa[i]);
    log += std::log(product);
  }
  for (std::int32_t e : sums.exponent) exponent += e;
  return log + std::numbers::ln2 * static_cast<double>(exponent);
}

double total(const float (&lane)[kLanes]) {
  double sum = 0;
  for (float value : lane) sum += static_cast<double>(value);
  return sum;
}

}  // namespace
}  // namespace ppm
#endif  // PPM_RANGE_KERNELS_ONCE

HWY_BEFORE_NAMESPACE();
namespace ppm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, kLanes>;
using Ints = hn::RebindToSigned<Floats>;
using FloatV = hn::Vec<Floats>;
using IntV = hn::Vec<Ints>;

// True at NaN too. Ne() would not do: of NaN it is true on some targets only.
HWY_INLINE hn::Mask<Floats> hit_mask(Floats d, FloatV expected_range) {
  return hn::Not(hn::Eq(expected_range, hn::Set(d, std::numeric_limits<float>::infinity())));
}

// Comparisons with NaN are false: it goes through.
HWY_INLINE FloatV at_least(Floats d, FloatV v, float least) {
  const auto limit = hn::Set(d, least);
  return hn::IfThenElse(hn::Lt(v, limit), limit, v);
}

// Multiplies `factor`, positive and normal, into a product kept as mantissa and exponent.
HWY_INLINE void multiply(Floats d, FloatV factor, FloatV& mantissa, IntV& exponent) {
  const Ints di;
  const auto bits = hn::BitCast(di, factor);
  exponent = hn::Add(exponent, hn::ShiftRight<23>(bits));
  const auto one_to_two = hn::Or(hn::And(bits, hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f800000));
  mantissa = hn::Mul(mantissa, hn::BitCast(d, one_to_two));
}

// 2^x for x <= 0, at least 2^-120: no subnormal numbers, which are slow. Relative error 1e-7.
HWY_INLINE FloatV exp2_of_negative(Floats d, FloatV x) {
  const Ints di;
  x = at_least(d, x, -120.0f);
  const auto whole = hn::Round(x);
  const auto part = hn::Sub(x, whole);
  auto p = hn::Set(d, 0.00132764718f);
  for (float c : {0.00967554133f, 0.0555071327f, 0.240221197f, 0.693146967f, 1.0f})
    p = hn::Add(hn::Mul(p, part), hn::Set(d, c));
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
  return hn::Mul(p, hn::BitCast(d, scale));
}

struct GaussianKernel {
  bool sensor_variance;

  void add(const RangeArrays& a, std::size_t end, std::size_t lane, LaneSums& sums) const {
    const Floats d;
    auto mantissa = hn::Load(d, sums.mantissa + lane), quadratic = hn::Load(d, sums.quadratic + lane),
         residual = hn::Load(d, sums.residual + lane), witness = hn::Load(d, sums.witness + lane);
    auto exponent = hn::Load(Ints(), sums.exponent + lane);
    std::size_t hits = 0, outliers = 0;
    for (std::size_t i = lane; i < end; i += kLanes) {
      const auto expected = hn::LoadU(d, a.expected_range + i);
      const auto hit = hit_mask(d, expected);
      const auto r = hn::IfThenElseZero(hit, hn::Sub(hn::LoadU(d, a.range + i), expected));
      auto variance = hn::LoadU(d, a.expected_variance + i);
      if (sensor_variance) variance = hn::Add(variance, hn::LoadU(d, a.variance + i));
      variance = hn::IfThenElse(hit, at_least(d, variance, kLeastRangeVariance), hn::Set(d, 1.0f));
      multiply(d, variance, mantissa, exponent);
      const auto r2 = hn::Mul(r, r);
      quadratic = hn::Add(quadratic, hn::Div(r2, variance));
      residual = hn::Add(residual, hn::Abs(r));
      witness = hn::Add(witness, variance);
      hits += hn::CountTrue(d, hit);
      outliers += hn::CountTrue(d, hn::Gt(r2, hn::Mul(hn::Set(d, 9.0f), variance)));
    }
    hn::Store(mantissa, d, sums.mantissa + lane);
    hn::Store(exponent, Ints(), sums.exponent + lane);
    hn::Store(quadratic, d, sums.quadratic + lane);
    hn::Store(residual, d, sums.residual + lane);
    hn::Store(witness, d, sums.witness + lane);
    sums.hits += hits;
    sums.outliers += outliers;
  }
};

// Of a hit with outlier density b: log of b + a N(r; v) is log b + log(1 + a / b N(r; v)); the second factor is at least 1.
struct MixtureKernel {
  float ratio;           // a / (b sqrt(2 pi))
  float model_variance;  // m^2 along the normal

  void add(const RangeArrays& a, std::size_t end, std::size_t lane, LaneSums& sums) const {
    const Floats d;
    const auto one = hn::Set(d, 1.0f);
    auto mantissa = hn::Load(d, sums.mantissa + lane), residual = hn::Load(d, sums.residual + lane),
         witness = hn::Load(d, sums.witness + lane);
    auto exponent = hn::Load(Ints(), sums.exponent + lane);
    std::size_t hits = 0, outliers = 0;
    for (std::size_t i = lane; i < end; i += kLanes) {
      const auto expected = hn::LoadU(d, a.expected_range + i), cosine = hn::LoadU(d, a.cosine + i),
                 lateral = hn::LoadU(d, a.lateral + i);
      const auto hit = hit_mask(d, expected);
      const auto r = hn::IfThenElseZero(hit, hn::Sub(hn::LoadU(d, a.range + i), expected));
      // the variance times cosine^2
      const auto c2 = hn::Mul(cosine, cosine);
      const auto along = hn::Add(hn::LoadU(d, a.variance + i), hn::LoadU(d, a.expected_variance + i));
      const auto across = hn::Mul(hn::Mul(lateral, lateral), hn::Sub(one, c2));
      const auto v = hn::Add(hn::Mul(along, c2), hn::Add(hn::Set(d, model_variance), across));
      const auto precision = hn::Div(c2, at_least(d, v, kLeastRangeVariance));
      const auto r2 = hn::Mul(r, r);
      const auto power = hn::Mul(hn::Mul(r2, precision), hn::Set(d, -0.5f * std::numbers::log2e_v<float>));
      const auto density = hn::Mul(hn::Sqrt(precision), exp2_of_negative(d, power));
      const auto surface = hn::IfThenElseZero(hit, hn::Mul(hn::Set(d, ratio), density));
      const auto factor = hn::Add(one, surface);
      multiply(d, factor, mantissa, exponent);
      residual = hn::Add(residual, hn::Abs(r));
      witness = hn::Add(witness, factor);
      hits += hn::CountTrue(d, hit);
      outliers += hn::CountTrue(d, hn::And(hit, hn::Lt(surface, one)));
    }
    hn::Store(mantissa, d, sums.mantissa + lane);
    hn::Store(exponent, Ints(), sums.exponent + lane);
    hn::Store(residual, d, sums.residual + lane);
    hn::Store(witness, d, sums.witness + lane);
    sums.hits += hits;
    sums.outliers += outliers;
  }
};

// On narrow vectors the block is gone through once for each part of the 16 lanes.
template <class Kernel>
LaneSums run(const Kernel& kernel, const RangeArrays& a) {
  LaneSums sums;
  const Tail tail(a);
  const bool rest = tail.done < a.size;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(Floats())) {
    kernel.add(a, tail.done, lane, sums);
    if (rest) kernel.add(tail.arrays(), kLanes, lane, sums);
  }
  sums.groups = static_cast<std::int64_t>(tail.done / kLanes + rest);
  return sums;
}

LaneSums gaussian(const RangeArrays& a, bool sensor_variance) {
  return run(GaussianKernel{sensor_variance}, a);
}

LaneSums mixture(const RangeArrays& a, float ratio, float model_variance) {
  return run(MixtureKernel{ratio, model_variance}, a);
}

}  // namespace ppm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {
namespace {

HWY_EXPORT(gaussian);
HWY_EXPORT(mixture);

ViewScore score_of(const LaneSums& sums, const RangeArrays& pixels, double log_likelihood) {
  const bool number = std::isfinite(total(sums.witness));
  return {number ? log_likelihood : std::numeric_limits<double>::quiet_NaN(), sums.hits, pixels.size - sums.hits,
          sums.outliers, total(sums.residual)};
}

}  // namespace

ViewScore gaussian_score(const RangeArrays& pixels, bool sensor_variance) {
  const LaneSums sums = HWY_DYNAMIC_DISPATCH(gaussian)(pixels, sensor_variance);
  const double log_scale = static_cast<double>(sums.hits) * std::log(2 * std::numbers::pi);
  return score_of(sums, pixels, -0.5 * (total(sums.quadratic) + log_product(sums) + log_scale));
}

ViewScore mixture_score(const RangeArrays& pixels, const MixtureTerms& terms) {
  const double ratio = terms.inlier_share / (terms.outlier_density * std::sqrt(2 * std::numbers::pi));
  const LaneSums sums =
      HWY_DYNAMIC_DISPATCH(mixture)(pixels, static_cast<float>(ratio), static_cast<float>(terms.model_variance));
  const double hits = static_cast<double>(sums.hits), misses = static_cast<double>(pixels.size - sums.hits);
  return score_of(sums, pixels,
                  log_product(sums) + hits * std::log(terms.outlier_density) + misses * std::log(terms.miss_density));
}

}  // namespace ppm
#endif
