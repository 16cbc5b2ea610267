#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/slam/frame.hpp"

namespace ppm {

/// What lies between two neighbouring pixels.
enum class Step : std::int8_t {
  closer = -1,  ///< a jump; the second pixel is nearer to the camera
  none = 0,     ///< one surface
  farther = 1,  ///< a jump; the second pixel is farther
  unknown = 2,  ///< one of them has no return
};

struct JumpSettings {
  double angle_least = 0.17;  ///< rad; surfaces that are seen more grazingly than this are taken for jumps
  double noise_sigmas = 3;    ///< differences of depth within so many standard deviations are none
};

/// The jumps of a frame: between two neighbouring points whose chord makes a smaller angle with the line of sight than
/// angle_least (a surface seen so grazingly would hardly be measured), and whose depths differ by more than noise.
/// Source: May et al., "Three-dimensional mapping with time-of-flight cameras", Journal of Field Robotics 26(11), 2009,
/// section 4 (jump edges).
struct DepthJumps {
  std::vector<Step> right;  ///< [rows*cols] from the pixel to the next of its row; unknown at the row's end
  std::vector<Step> down;   ///< [rows*cols] from the pixel to the one below; unknown in the last row
};
DepthJumps depth_jumps(const Frame& frame, const JumpSettings& settings, const Workers& workers);

}  // namespace ppm
