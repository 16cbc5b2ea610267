#pragma once
#include <Eigen/Geometry>

namespace ppm {

/// A rigid motion. T_dst_src maps points given in frame src to frame dst: p_dst = T_dst_src * p_src. Metres.
using Pose = Eigen::Isometry3d;
/// A twist, translation first: [v (m), w (rad)].
using Twist = Eigen::Matrix<double, 6, 1>;

/// Exponential map of SE(3). Source: Barfoot, "State Estimation for Robotics", section 7.1.3.
Pose se3_exp(const Twist& xi);
/// Logarithm of SE(3), inverse of se3_exp for rotations below pi.
Twist se3_log(const Pose& T);
/// The pose at fraction t in [0, 1] of the way from a to b: straight line for the translation, slerp for the rotation.
Pose interpolate(const Pose& a, const Pose& b, double t);
/// The nearest pose with an orthonormal rotation (polar decomposition).
Pose orthonormalized(const Eigen::Matrix4d& T);
/// True when every entry is finite.
bool is_finite(const Pose& T);
/// Angle of the rotation, rad, in [0, pi].
double rotation_angle(const Pose& T);
/// Whether two poses are nearer to each other than both limits.
bool are_near(const Pose& a, const Pose& b, double distance_m, double angle_rad);

}  // namespace ppm
