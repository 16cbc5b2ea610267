#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>

#include "framework/config/params.hpp"
#include "framework/slam/pixel_block.hpp"

namespace ppm {

inline double log_normal(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(2 * std::numbers::pi * variance));
}

/// The paper's density of a measured range: a normal distribution about the expected one.
struct RangeGaussian {
  enum class Variance { texel, texel_and_sensor } of = Variance::texel;

  /// Declares the parameter `variance`.
  void declare(Params& params);
  /// m^2 along the ray, of the i-th pixel.
  double variance(const PixelBlock& pixels, std::size_t i) const;
};

}  // namespace ppm
