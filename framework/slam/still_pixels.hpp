#pragma once
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm {

/// What one pixel of a still camera measured in several images.
struct StillPixel {
  int group = 0;                 ///< which place
  float range = 0;               ///< m along the ray, mean
  float amplitude = 0;           ///< Frame::confidence, mean; 0 where the frames have none
  float variance = 0;            ///< m^2 of the range, unbiased, from `images` measurements
  std::vector<float> deviation;  ///< [images] m, each range less the mean
};

/// The pixels that have a return in all images of a group. frames: at least two, of one camera, which did not move, nor
/// did anything that it saw. Throws DataError where cameras differ or only some frames have a confidence.
std::vector<StillPixel> still_pixels(const std::vector<Frame>& frames, int group);

}  // namespace ppm
