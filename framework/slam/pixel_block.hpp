#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "framework/slam/measured_pixels.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// Some consecutive measured pixels of a frame beside what one view shows there: what a likelihood is given at a time,
/// small enough for the core's nearest cache. Refers to memory of others.
struct PixelBlock {
  const Frame& frame;
  std::span<const std::uint32_t> source;  ///< index of each pixel into the arrays of the frame
  std::span<const float> range;           ///< m along the ray, measured
  std::span<const float> variance;        ///< m^2 of the measured range
  std::span<const float> lateral;         ///< m, standard deviation across the ray
  const ViewSamples& expected;            ///< of the same pixels; with colour where the likelihood uses it

  /// The measured pixels first, first + 1, .. that `samples` belong to.
  PixelBlock(const Frame& f, const MeasuredPixels& measured, std::size_t first, const ViewSamples& samples)
      : frame(f),
        source(std::span(measured.source).subspan(first, samples.size())),
        range(std::span(measured.range).subspan(first, samples.size())),
        variance(std::span(measured.variance).subspan(first, samples.size())),
        lateral(std::span(measured.lateral).subspan(first, samples.size())),
        expected(samples) {}

  std::size_t size() const { return range.size(); }
  /// False where the map shows nothing.
  bool hit(std::size_t i) const { return expected.range[i] != Prediction::kMiss; }
  /// m, measured minus expected range, of a hit.
  float residual(std::size_t i) const { return range[i] - expected.range[i]; }
};

}  // namespace ppm
