#pragma once
#include <Eigen/Core>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Where the camera that took the colour images is, beside the one that took depth: parallel to it, with an image of
/// the same size and principal point.
struct ColorCamera {
  double focal_px = 0;                                      ///< 0: the colour images are registered to depth already
  Eigen::Vector3d t_color_depth = Eigen::Vector3d::Zero();  ///< m: p_color = p_depth + t_color_depth

  bool is_registered() const { return focal_px == 0; }
};

/// Gives each pixel of frame.color the colour that the other camera saw of its measured point, interpolated; where
/// nothing was measured, of a point at infinity in its direction; beyond the colour image, that of its border. A point
/// that something nearer hides from the colour camera takes the colour of that: beside an edge from z1 to z2 a stripe
/// of |t| focal (1/z1 - 1/z2) pixels.
void register_color(const ColorCamera& camera, Frame& frame);

}  // namespace ppm
