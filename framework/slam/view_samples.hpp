#pragma once
#include <cstddef>
#include <vector>

namespace ppm {

/// What a view shows at some pixels, as a likelihood compares it: one entry a pixel, in the order of the pixels. Kept
/// between calls for its memory.
struct ViewSamples {
  /// m along the ray to the described surface, to first order (Prediction::expected_range); Prediction::kMiss where the
  /// map shows nothing.
  std::vector<float> range;
  std::vector<float> variance;  ///< m^2 of that range, by the map alone; 0 at a miss
  std::vector<float> cosine;    ///< |normal . ray|, at least Prediction::kMinCosine; 1 at a miss
  int color_channels = 0;       ///< C: 0 where no colour is asked for
  std::vector<float> color;     ///< [C*pixels] interleaved, 0 .. 1; 0 at a miss
  std::vector<float> color_variance;  ///< [pixels], empty where C = 0

  /// channels: of colour that is asked for: none, or all that the view has.
  void resize(std::size_t pixels, int channels = 0);
  std::size_t size() const { return range.size(); }
};

}  // namespace ppm
