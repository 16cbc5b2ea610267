#pragma once
#include "framework/slam/camera_correction.hpp"
#include "framework/slam/frame.hpp"

namespace ppm {

/// What is done to every image as read, whatever the source: correction of the camera, then range limits, noise model,
/// decimation. The noise model stands until a sensor.* node replaces it.
struct FrameConditioning {
  CameraCorrection correction;
  double min_range_m = 0.3, max_range_m = 10.0;  ///< of depth along the optical axis, both ends allowed
  double sigma_floor = 0.0012;                   ///< m
  double sigma_quadratic = 0.0019;               ///< 1/m
  double sigma_near = 0.4;                       ///< m
  double sigma_lateral = 0.5;                    ///< px of the image as read
  double sigma_color = 0.03;                     ///< of a colour channel, 0 .. 1

  /// Standard deviation of a depth, m. Source: Nguyen, Izadi, Lovell, "Modeling Kinect sensor noise for improved 3D
  /// reconstruction and tracking", 3DIMPVT 2012 (axial noise).
  double sigma(double depth_m) const;
  /// Each stride-th pixel of each stride-th row, from pixel (0, 0) on; corrected depth that is not finite or out of range
  /// becomes NaN; sigma is filled where the source left it empty, and NaN where depth is. lateral_px is sigma_lateral / stride:
  /// pixels that are left out do not make those that stay less exact.
  Frame apply(const Frame& image, int stride) const;
};

}  // namespace ppm
