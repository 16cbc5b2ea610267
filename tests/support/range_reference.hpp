#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "framework/core/rng.hpp"
#include "modules/weighting/range_kernels.hpp"

namespace ppm::test {

/// Pixels as a view of a room has them: hits within the noise, hits far off, misses, flat and slanted surface.
struct RangePixels {
  std::vector<float> range, variance, lateral, expected_range, expected_variance, cosine;

  explicit RangePixels(std::size_t n, std::uint64_t seed = 1) {
    Rng rng(seed, 0, 0, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const double r = 0.5 + 4 * rng.uniform(), c = 0.2 + 0.8 * rng.uniform(), kind = rng.uniform();
      const double off = kind < 0.8 ? 0.01 * rng.normal() : rng.normal();
      range.push_back(static_cast<float>(r));
      variance.push_back(static_cast<float>(std::pow(0.002 + 0.003 * r, 2)));
      lateral.push_back(static_cast<float>(0.003 * r));
      const bool miss = kind > 0.95;
      expected_range.push_back(miss ? INFINITY : static_cast<float>(r + off));
      expected_variance.push_back(miss ? 0.0f : static_cast<float>(1e-5 * rng.uniform() / (c * c)));
      cosine.push_back(miss ? 1.0f : static_cast<float>(c));
    }
  }
  RangeArrays arrays(std::size_t first, std::size_t n) const {
    return {&range[first],          &variance[first],          &lateral[first],
            &expected_range[first], &expected_variance[first], &cosine[first],
            n};
  }
};

/// gaussian_score() pixel by pixel in double.
inline ViewScore gaussian_reference(const RangeArrays& a, bool sensor_variance) {
  ViewScore s;
  for (std::size_t i = 0; i < a.size; ++i) {
    if (a.expected_range[i] == INFINITY) {
      ++s.misses;
      continue;
    }
    const double r = a.range[i] - a.expected_range[i];
    const double map = a.expected_variance[i], sensor = sensor_variance ? a.variance[i] : 0.0;
    const double v = std::max(map + sensor, 1e-10);
    s.log_likelihood -= 0.5 * (r * r / v + std::log(2 * std::numbers::pi * v));
    s.outliers += r * r > 9 * v;
    s.residual_sum += std::abs(r);
    ++s.hits;
  }
  return s;
}

/// mixture_score() pixel by pixel in double.
inline ViewScore mixture_reference(const RangeArrays& a, const MixtureTerms& terms) {
  const double inlier = terms.inlier_share / std::sqrt(2 * std::numbers::pi), log_miss = std::log(terms.miss_density);
  ViewScore s;
  for (std::size_t i = 0; i < a.size; ++i) {
    if (a.expected_range[i] == INFINITY) {
      ++s.misses;
      s.log_likelihood += log_miss;
      continue;
    }
    const double r = a.range[i] - a.expected_range[i], c2 = a.cosine[i] * a.cosine[i];
    const double l2 = std::pow(a.lateral[i], 2), map = a.expected_variance[i];
    const double v = a.variance[i] + map + (terms.model_variance + l2 * (1 - c2)) / c2;
    const double surface = inlier / std::sqrt(v) * std::exp(-0.5 * r * r / v);
    s.log_likelihood += std::log(surface + terms.outlier_density);
    s.outliers += terms.outlier_density > surface;
    s.residual_sum += std::abs(r);
    ++s.hits;
  }
  return s;
}

}  // namespace ppm::test
