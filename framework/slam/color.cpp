#include "framework/slam/color.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

/// Ratios of darker values are mostly noise, and brighter ones are cut off.
constexpr float kDark = 0.08f, kSaturated = 0.96f;
constexpr float kPriorPixels = 20;  // that say 1

bool is_usable(float value) {
  return value > kDark && value < kSaturated;
}

}  // namespace

ColorValue color_of(const Frame& frame, std::size_t pixel, int channels) {
  constexpr float kScale = 1.0f / 255;
  const std::uint8_t* rgb = &frame.color[3 * pixel];
  if (channels == 1) return {kScale * (0.299f * rgb[0] + 0.587f * rgb[1] + 0.114f * rgb[2]), 0, 0};
  return {kScale * rgb[0], kScale * rgb[1], kScale * rgb[2]};
}

void ColorGain::add(const ColorValue& measured, const ColorValue& expected) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c)
    if (is_usable(measured[c]) && is_usable(expected[c])) log_ratio_[c].push_back(std::log(measured[c] / expected[c]));
}

ColorValue ColorGain::estimate() {
  ColorValue gain{1, 1, 1};
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
    auto& ratios = log_ratio_[c];
    if (ratios.empty()) continue;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    const auto n = static_cast<float>(ratios.size());
    gain[c] = std::exp(*middle * n / (n + kPriorPixels));
  }
  return gain;
}

}  // namespace ppm
