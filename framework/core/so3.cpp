#include "framework/core/so3.hpp"

#include <cmath>

namespace ppm {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& w) {
  Twist xi = Twist::Zero();
  xi.tail<3>() = w;
  return se3_exp(xi).linear();
}

Eigen::Matrix3d so3_right_jacobian(const Eigen::Vector3d& w) {
  const double t2 = w.squaredNorm(), t = std::sqrt(t2);
  constexpr double kSeriesBelow = 0.05;  // rad
  const double a = t < kSeriesBelow ? 0.5 - t2 / 24 * (1 - t2 / 30) : (1 - std::cos(t)) / t2;
  const double b = t < kSeriesBelow ? 1.0 / 6 - t2 / 120 * (1 - t2 / 42) : (t - std::sin(t)) / (t2 * t);
  const Eigen::Matrix3d W = skew(w);
  return Eigen::Matrix3d::Identity() - a * W + b * W * W;
}

Eigen::Matrix<double, 6, 6> adjoint(const Pose& T) {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
  return A;
}

}  // namespace ppm
