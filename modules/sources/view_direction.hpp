#pragma once
#include <Eigen/Geometry>

namespace ppm {

/// Camera axes (x right, y down, z forward) in a world whose z is up, for a direction of view; rad. roll turns the image
/// about it.
Eigen::Matrix3d camera_axes(double yaw, double pitch, double roll);

}  // namespace ppm
