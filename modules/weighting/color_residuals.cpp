#include "modules/weighting/color_residuals.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {

ColorResiduals::ColorResiduals(const Frame& frame, const MeasuredPixels& measured, const ViewSamples& expected,
                               CompareColor exposure) {
  const auto channels = static_cast<std::size_t>(expected.color_channels);
  if (channels == 0)
    throw ConfigError({}, "colours are to be weighed, but the map has none; set `color` of the node that starts it");
  if (frame.color.empty())
    throw DataError("the source", frame.index, "gives no colour to be weighed; set `color: true` at the source");
  const std::size_t n = measured.size();
  std::vector<ColorValue> shown(n, ColorValue{});
  residual.resize(n);
  map_variance.resize(n);
  ColorGain comparison(expected.color_channels);
  for (std::size_t i = 0; i < n; ++i) {
    if (expected.range[i] == Prediction::kMiss) continue;
    std::copy_n(&expected.color[channels * i], channels, shown[i].begin());
    residual[i] = color_of(frame, measured.source[i], expected.color_channels);
    map_variance[i] = expected.color_variance[i];
    if (exposure == CompareColor::gain) comparison.add(residual[i], shown[i]);
  }
  const ColorValue gain = comparison.estimate();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < channels; ++c) residual[i][c] = residual[i][c] / gain[c] - shown[i][c];
  const float sensor = frame.color_sigma / *std::min_element(gain.begin(), gain.begin() + expected.color_channels);
  sensor_variance = sensor * sensor;
}

}  // namespace ppm
