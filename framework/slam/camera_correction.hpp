#pragma once
#include "framework/slam/frame.hpp"

namespace ppm {

/// What is wrong with a range camera as its images describe it, and is put right before anything looks at them.
struct CameraCorrection {
  double focal_scale = 1;              ///< fx and fy are multiplied by it
  double cx_shift = 0, cy_shift = 0;   ///< px of the image as read, added to the principal point
  double depth_factor = 1;             ///< z' = depth_factor z + depth_bend z^2
  double depth_bend = 0;               ///< 1/m

  Camera camera(const Camera& as_read) const;
  /// m; NaN where the distortion is no longer increasing: beyond that a depth does not say how far away something is.
  double depth(double z) const;
  /// dz'/dz, by which noise grows.
  double depth_slope(double z) const { return depth_factor + 2 * depth_bend * z; }
  bool operator==(const CameraCorrection&) const = default;
};

/// Corrects depth and, where the frame has it, sigma in place.
void correct_depth(const CameraCorrection& correction, Frame& frame);

}  // namespace ppm
