#include "framework/core/se3.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "framework/core/so3.hpp"

namespace ppm {

namespace {

// Below this angle (rad) the closed forms lose digits and the series to theta^6 have all of them.
constexpr double kSeriesBelow = 0.1;

/// Unit quaternion with w >= 0 of a rotation.
Eigen::Quaterniond half_turn_quaternion(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q.normalized();
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& R) {
  const auto q = half_turn_quaternion(R);
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(s, q.w()) / s) * q.vec();
}

}  // namespace

Pose se3_exp(const Twist& xi) {
  const Eigen::Vector3d w = xi.tail<3>();
  const double t = w.norm(), t2 = t * t;
  double sinc_half, b;  // sin(t/2)/t, (t-sin t)/t^3
  if (t < kSeriesBelow) {
    sinc_half = 0.5 - t2 * (1.0 / 48 - t2 * (1.0 / 3840 - t2 / 645120));
    b = 1.0 / 6 - t2 * (1.0 / 120 - t2 * (1.0 / 5040 - t2 / 362880));
  } else {
    sinc_half = std::sin(0.5 * t) / t;
    b = (t - std::sin(t)) / (t2 * t);
  }
  const double a = 2.0 * sinc_half * sinc_half;  // (1-cos t)/t^2
  const Eigen::Vector3d v = sinc_half * w;
  const Eigen::Matrix3d W = skew(w);
  Pose T = Pose::Identity();
  T.linear() = Eigen::Quaterniond(std::cos(0.5 * t), v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  T.translation() = (Eigen::Matrix3d::Identity() + a * W + b * W * W) * xi.head<3>();
  return T;
}

Twist se3_log(const Pose& T) {
  const Eigen::Vector3d w = so3_log(T.linear());
  const double t = w.norm(), t2 = t * t, half = 0.5 * t;
  const double c = t < kSeriesBelow ? 1.0 / 12 + t2 * (1.0 / 720 + t2 * (1.0 / 30240 + t2 / 1209600))
                                    : (1.0 - half / std::tan(half)) / t2;
  const Eigen::Matrix3d W = skew(w);
  Twist xi;
  xi.head<3>() = (Eigen::Matrix3d::Identity() - 0.5 * W + c * W * W) * T.translation();
  xi.tail<3>() = w;
  return xi;
}

Pose interpolate(const Pose& a, const Pose& b, double t) {
  Pose T = Pose::Identity();
  T.linear() = Eigen::Quaterniond(a.linear()).slerp(t, Eigen::Quaterniond(b.linear())).normalized().toRotationMatrix();
  T.translation() = (1.0 - t) * a.translation() + t * b.translation();
  return T;
}

Pose orthonormalized(const Eigen::Matrix4d& T) {
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(T.topLeftCorner<3, 3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  Pose P = Pose::Identity();
  P.linear() = U * svd.matrixV().transpose();
  P.translation() = T.topRightCorner<3, 1>();
  return P;
}

bool is_finite(const Pose& T) {
  return T.matrix().allFinite();
}

double rotation_angle(const Pose& T) {
  return so3_log(T.linear()).norm();
}

bool are_near(const Pose& a, const Pose& b, double distance_m, double angle_rad) {
  const Pose between = a.inverse() * b;
  return between.translation().norm() < distance_m && rotation_angle(between) < angle_rad;
}

}  // namespace ppm
