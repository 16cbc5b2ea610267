#pragma once
#include "framework/slam/frame.hpp"

namespace ppm {

/// What is wrong with a range camera as its images describe it, and is put right before anything looks at them.
/// Depth: z' = factor z / (1 - b z), where b = bend + bend_x X + bend_y Y + bend_radial (X^2 + Y^2) and (X, Y, 1) is the pixel's
/// ray, by the corrected camera. It is a small smooth error of disparity (1/z' = (1/z - b) / factor), the way in which
/// structured light and stereo err; z' is factor (z + b z^2) to first order.
/// Source: Herrera, Kannala, Heikkila, "Joint depth and color camera calibration with distortion correction", PAMI 2012.
struct CameraCorrection {
  double focal_scale = 1;             ///< fx and fy are multiplied by it
  double cx_shift = 0, cy_shift = 0;  ///< px of the image as read, added to the principal point
  double depth_factor = 1;
  double depth_bend = 0, depth_bend_x = 0, depth_bend_y = 0, depth_bend_radial = 0;  ///< 1/m

  Camera camera(const Camera& as_read) const;
  bool changes_depth() const;
  /// b of a pixel; ray: Camera::ray of the corrected camera.
  double bend(const Eigen::Vector3d& ray) const {
    return depth_bend + depth_bend_x * ray.x() + depth_bend_y * ray.y() + depth_bend_radial * ray.head<2>().squaredNorm();
  }
  /// m; NaN from b z = 1 on, where the corrected depth has passed infinity.
  double depth(double z, double bend) const;
  /// dz'/dz, by which noise grows.
  double depth_slope(double z, double bend) const { return depth_factor / ((1 - bend * z) * (1 - bend * z)); }
  bool operator==(const CameraCorrection&) const = default;
};

/// Corrects depth and, where the frame has it, sigma in place. The frame's camera is the corrected one.
void correct_depth(const CameraCorrection& correction, Frame& frame);

}  // namespace ppm
