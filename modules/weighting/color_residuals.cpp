#include "modules/weighting/color_residuals.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {

ColorResiduals::ColorResiduals(const PixelBlock& pixels, CompareColor exposure) : pixels_(pixels) {
  if (channels() == 0)
    throw ConfigError({}, "colours are to be weighed, but the map has none; set `color` of the node that starts it");
  if (pixels.frame.color.empty())
    throw DataError("the source", pixels.frame.index, "gives no colour to be weighed; set `color: true` at the source");
  if (exposure == CompareColor::gain) {
    ColorGain comparison(pixels.expected.color_channels);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (pixels.hit(i)) comparison.add(measured(i), expected(i));
    gain_ = comparison.estimate();
  }
  const float sensor =
      pixels.frame.color_sigma / *std::min_element(gain_.begin(), gain_.begin() + pixels.expected.color_channels);
  sensor_variance_ = sensor * sensor;
}

ColorValue ColorResiduals::measured(std::size_t i) const {
  return color_of(pixels_.frame, pixels_.source[i], pixels_.expected.color_channels);
}

ColorValue ColorResiduals::expected(std::size_t i) const {
  ColorValue shown{};
  std::copy_n(&pixels_.expected.color[channels() * i], channels(), shown.begin());
  return shown;
}

ColorValue ColorResiduals::residual(std::size_t i) const {
  ColorValue off = measured(i);
  const ColorValue shown = expected(i);
  for (std::size_t c = 0; c < channels(); ++c) off[c] = off[c] / gain_[c] - shown[c];
  return off;
}

}  // namespace ppm
