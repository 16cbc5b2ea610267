#pragma once
#include <Eigen/Core>

#include "framework/core/se3.hpp"

namespace ppm {

/// The matrix of the cross product: skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);
/// Exponential map of SO(3): rotation about w by |w| rad.
Eigen::Matrix3d so3_exp(const Eigen::Vector3d& w);
/// Right Jacobian of SO(3): exp(w + d) = exp(w) exp(J d) to first order in d.
/// Source: Barfoot, "State Estimation for Robotics", section 7.1.5.
Eigen::Matrix3d so3_right_jacobian(const Eigen::Vector3d& w);

/// How a twist reads in another frame of the same rigid body: T exp(xi) = exp(Ad xi) T, so with T_b = T_a T_ab the twist
/// adjoint(T_ab) * xi_b at the right of T_a does what xi_b does at the right of T_b. Translation first, like Twist.
Eigen::Matrix<double, 6, 6> adjoint(const Pose& T);

}  // namespace ppm
