#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "framework/slam/camera_correction.hpp"

namespace ppm {

/// What of a camera can be found from its images.
/// focal  logarithm of focal_scale
/// cx, cy  principal point, px
/// bend, bend_x, bend_y, bend_radial  distortion of depth, 1/m; with bend, depth_factor changes so that a depth of `pivot_m` in
///        the middle stays what it is. The factor itself, the size of the world, cannot be seen by a camera that is moved: all
///        lengths grow alike
enum class CameraParameter { focal, cx, cy, bend, bend_x, bend_y, bend_radial };
constexpr Eigen::Index kMostCameraParameters = 7;

std::string to_string(CameraParameter parameter);

/// The parameters that are sought, as a vector.
struct CameraParameters {
  std::vector<CameraParameter> free;
  double pivot_m = 2;

  Eigen::Index size() const { return static_cast<Eigen::Index>(free.size()); }
  /// The correction changed by a step of the parameters.
  CameraCorrection moved(const CameraCorrection& from, const Eigen::VectorXd& step) const;
};

}  // namespace ppm
