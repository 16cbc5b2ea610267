#pragma once
#include <cstdint>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Odometry that counts the steps of a camera and drifts. Each step's translation and rotation, in the axes of its beginning,
/// get normal noise whose standard deviation on each axis grows with the step's length and turn.
/// Source: Thrun, Burgard, Fox, "Probabilistic Robotics", 2005, section 5.4 (noise in proportion to motion), carried over to
/// six degrees of freedom.
struct SimulatedOdometry {
  double t_per_m = 0.01;     ///< m/m
  double t_per_rad = 0.057;  ///< m/rad
  double r_per_m = 0.017;    ///< rad/m
  double r_per_rad = 0.05;   ///< rad/rad

  /// The sums of the steps, the first one the identity: T_odom_base of each pose. jumps_s: times at which the camera was
  /// somewhere else all at once, ascending; the step over a jump is not counted. A function of the arguments.
  std::vector<Pose> poses(const std::vector<StampedPose>& path, const std::vector<double>& jumps_s, std::uint64_t seed) const;
};

}  // namespace ppm
