#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Up to three channels of one colour; those beyond the number at hand are 0.
using ColorValue = std::array<float, 3>;

/// The colour of a pixel, 0 .. 1 as the camera encodes it: red, green, blue, or their luma where channels is 1
/// (ITU-R BT.601). The frame must have colour.
ColorValue color_of(const Frame& frame, std::size_t pixel, int channels);

/// How much brighter an image is than expected, one factor a channel: what automatic exposure and white balance change
/// from image to image. The median of measured / expected over the pixels that are neither dark nor saturated, drawn
/// towards 1 where they are few: a wrong pixel, an edge or a highlight does not move it.
class ColorGain {
 public:
  explicit ColorGain(int channels) : channels_(channels) {}
  void add(const ColorValue& measured, const ColorValue& expected);
  /// Rearranges what was added.
  ColorValue estimate();

 private:
  int channels_;
  std::array<std::vector<float>, 3> log_ratio_;
};

}  // namespace ppm
