#pragma once
#include <cstddef>

#include "framework/slam/pixel_block.hpp"

namespace ppm {

/// Normalised residuals of one view: (measured - expected range) / standard deviation that sensor, place across the ray and
/// map give it together. Of a filter whose noise is right they have mean 0 and variance 1.
/// Source: Bar-Shalom, Li, Kirubarajan, "Estimation with applications to tracking and navigation", 2001, section 5.4.
struct Innovation {
  std::size_t count = 0;  ///< pixels within kGate standard deviations: what is farther off is another surface
  double sum = 0, squares = 0;

  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  double variance() const { return count > 0 ? squares / static_cast<double>(count) - mean() * mean() : 0; }
  /// Takes each kEvery-th pixel of the block where the map shows something.
  void add(const PixelBlock& pixels);

  static constexpr double kGate = 5;
  static constexpr std::size_t kEvery = 8;
};

}  // namespace ppm
