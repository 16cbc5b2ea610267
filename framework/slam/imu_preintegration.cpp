#include "framework/slam/imu_preintegration.hpp"

#include "framework/core/error.hpp"
#include "framework/core/so3.hpp"

namespace ppm {

namespace {

using Eigen::Matrix3d;

/// The signals between two samples at a time.
ImuSample between(const ImuSample& a, const ImuSample& b, double stamp_s) {
  const double t = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
  return {stamp_s, a.gyro + t * (b.gyro - a.gyro), a.accel + t * (b.accel - a.accel)};
}

}  // namespace

void ImuMotion::add(const Eigen::Vector3d& gyro, const Eigen::Vector3d& accel, double dt_s, const ImuNoise& noise) {
  const Eigen::Vector3d w = (gyro - bias.gyro) * dt_s, a = accel - bias.accel;
  const Matrix3d step = so3_exp(w), half = so3_exp(0.5 * w);
  const Matrix3d J = so3_right_jacobian(w) * dt_s, J_half = so3_right_jacobian(0.5 * w) * (0.5 * dt_s);
  const Matrix3d R_mid = R * half, turned = -R_mid * skew(a);

  // Errors before the step, and the noise of rate and force in it, to errors after it.
  Matrix9 A = Matrix9::Identity();
  Eigen::Matrix<double, 9, 6> B = Eigen::Matrix<double, 9, 6>::Zero();
  A.block<3, 3>(0, 0) = step.transpose();
  A.block<3, 3>(3, 0) = turned * half.transpose() * dt_s;
  A.block<3, 3>(6, 0) = 0.5 * dt_s * A.block<3, 3>(3, 0);
  A.block<3, 3>(6, 3) = dt_s * Matrix3d::Identity();
  B.block<3, 3>(0, 0) = J;
  B.block<3, 3>(3, 0) = turned * J_half * dt_s;
  B.block<3, 3>(3, 3) = R_mid * dt_s;
  B.bottomRows<3>() = 0.5 * dt_s * B.middleRows<3>(3);
  Eigen::Matrix<double, 6, 1> variance;
  variance << Eigen::Vector3d::Constant(noise.gyro * noise.gyro / dt_s),
      Eigen::Vector3d::Constant(noise.accel * noise.accel / dt_s);
  covariance = (A * covariance * A.transpose() + B * variance.asDiagonal() * B.transpose()).eval();

  const Matrix3d mid_gyro = half.transpose() * R_gyro - J_half;
  p_gyro += dt_s * v_gyro + 0.5 * dt_s * dt_s * turned * mid_gyro;
  p_accel += dt_s * v_accel - 0.5 * dt_s * dt_s * R_mid;
  v_gyro += dt_s * turned * mid_gyro;
  v_accel -= dt_s * R_mid;
  R_gyro = (step.transpose() * R_gyro - J).eval();

  p += dt_s * v + 0.5 * dt_s * dt_s * (R_mid * a);
  v += dt_s * (R_mid * a);
  R = (R * step).eval();
  dt += dt_s;
}

ImuMotion ImuMotion::with_bias(const ImuBias& other) const {
  const Eigen::Vector3d gyro = other.gyro - bias.gyro, accel = other.accel - bias.accel;
  ImuMotion out = *this;
  out.R = R * so3_exp(R_gyro * gyro);
  out.v += v_gyro * gyro + v_accel * accel;
  out.p += p_gyro * gyro + p_accel * accel;
  out.bias = other;
  return out;
}

ImuMotion preintegrate(std::span<const ImuSample> samples, const std::optional<ImuSample>& before, double begin_s,
                       double end_s, const ImuBias& bias, const ImuNoise& noise) {
  PPM_CHECK(!samples.empty() && begin_s < end_s, "{} samples from {} s to {} s", samples.size(), begin_s, end_s);
  ImuMotion motion;
  motion.bias = bias;
  ImuSample at = before ? between(*before, samples.front(), begin_s) : samples.front();
  at.stamp_s = begin_s;
  const auto go_to = [&](const ImuSample& next) {
    if (next.stamp_s > at.stamp_s)
      motion.add(0.5 * (at.gyro + next.gyro), 0.5 * (at.accel + next.accel), next.stamp_s - at.stamp_s, noise);
    at = next;
  };
  for (const auto& sample : samples) go_to(sample);
  ImuSample last = samples.back();
  last.stamp_s = end_s;
  go_to(last);
  return motion;
}

}  // namespace ppm
