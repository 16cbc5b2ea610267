#include "modules/sources/view_direction.hpp"

#include <cmath>

namespace ppm {

Eigen::Matrix3d camera_axes(double yaw, double pitch, double roll) {
  const Eigen::Vector3d forward(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const Eigen::Vector3d right(std::sin(yaw), -std::cos(yaw), 0);
  Eigen::Matrix3d R;
  R << right, forward.cross(right), forward;
  return R * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
}

}  // namespace ppm
