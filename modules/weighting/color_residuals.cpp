#include "modules/weighting/color_residuals.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {

ColorResiduals::ColorResiduals(const Frame& frame, const MeasuredPixels& measured, const Prediction& prediction,
                               CompareColor exposure) {
  const auto channels = static_cast<std::size_t>(prediction.color_channels);
  if (channels == 0)
    throw ConfigError({}, "colours are to be weighed, but the map has none; set `color` of the node that starts it");
  if (frame.color.empty())
    throw DataError("the source", frame.index, "gives no colour to be weighed; set `color: true` at the source");
  const std::size_t n = measured.size();
  std::vector<ColorValue> expected(n, ColorValue{});
  residual.resize(n);
  map_variance.resize(n);
  ColorGain comparison(prediction.color_channels);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t p = measured.pixel[i];
    if (!prediction.hit(p)) continue;
    std::copy_n(&prediction.color[channels * p], channels, expected[i].begin());
    residual[i] = color_of(frame, measured.source[i], prediction.color_channels);
    map_variance[i] = prediction.color_variance[p];
    if (exposure == CompareColor::gain) comparison.add(residual[i], expected[i]);
  }
  const ColorValue gain = comparison.estimate();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < channels; ++c) residual[i][c] = residual[i][c] / gain[c] - expected[i][c];
  const float sensor = frame.color_sigma / *std::min_element(gain.begin(), gain.begin() + prediction.color_channels);
  sensor_variance = sensor * sensor;
}

}  // namespace ppm
