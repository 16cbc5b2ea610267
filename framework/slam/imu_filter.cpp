#include "framework/slam/imu_filter.hpp"

#include <Eigen/Cholesky>

#include "framework/core/error.hpp"
#include "framework/core/so3.hpp"

namespace ppm {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Places in the error vector.
constexpr int kT = 0, kR = 3, kV = 6, kGyro = 9, kAccel = 12, kG = 15;

Matrix3d variance(double sigma) {
  return sigma * sigma * Matrix3d::Identity();
}

/// The projection on the plane across a direction.
Matrix3d across(const Vector3d& direction) {
  const Vector3d u = direction.normalized();
  return Matrix3d::Identity() - u * u.transpose();
}

}  // namespace

void ImuFilter::begin(double stamp_now_s, const Pose& T_map_base_now, std::span<const ImuSample> samples,
                      const Matrix6& pose_noise, const ImuStart& start) {
  Vector3d force = Vector3d::Zero();
  for (const auto& s : samples) force += s.accel;
  PPM_CHECK(force.norm() > 0, "{} samples without force tell no vertical", samples.size());
  stamp_s = stamp_now_s;
  T_map_base = T_map_base_now;
  slips = 0;
  velocity.setZero();
  bias = {};
  gravity = -kGravity * (T_map_base.linear() * force).normalized();
  covariance.setZero();
  covariance.topLeftCorner<6, 6>() = pose_noise;
  covariance.block<3, 3>(kV, kV) = variance(start.speed);
  covariance.block<3, 3>(kGyro, kGyro) = variance(start.gyro_bias);
  covariance.block<3, 3>(kAccel, kAccel) = variance(start.accel_bias);
  // The force was f = a + b - R^T g: what the body's acceleration and the bias add to it, and the rotation's error, tilt
  // gravity by as much.
  Eigen::Matrix<double, 3, kSize> tilt = Eigen::Matrix<double, 3, kSize>::Zero();
  tilt.block<3, 3>(0, kR) = -T_map_base.linear() * skew(T_map_base.linear().transpose() * gravity);
  tilt.block<3, 3>(0, kAccel) = T_map_base.linear();
  covariance.bottomRows<3>() = tilt * covariance;
  covariance.rightCols<3>() = covariance.bottomRows<3>().transpose();
  covariance.block<3, 3>(kG, kG) = tilt.leftCols<kG>() * covariance.topRightCorner<kG, 3>() + variance(start.accel);
  keep_gravity_length();
}

void ImuFilter::predict(const ImuMotion& raw, const ImuNoise& noise) {
  const ImuMotion m = raw.with_bias(bias);
  const Matrix3d R = T_map_base.linear(), R_next = R * m.R, back = R_next.transpose();
  const double dt = m.dt;

  Covariance F = Covariance::Identity();
  F.block<3, 3>(kT, kT) = m.R.transpose();
  F.block<3, 3>(kT, kR) = -m.R.transpose() * skew(m.p);
  F.block<3, 3>(kT, kV) = dt * back;
  F.block<3, 3>(kT, kGyro) = m.R.transpose() * m.p_gyro;
  F.block<3, 3>(kT, kAccel) = m.R.transpose() * m.p_accel;
  F.block<3, 3>(kT, kG) = 0.5 * dt * dt * back;
  F.block<3, 3>(kR, kR) = m.R.transpose();
  F.block<3, 3>(kR, kGyro) = m.R_gyro;
  F.block<3, 3>(kV, kR) = -R * skew(m.v);
  F.block<3, 3>(kV, kGyro) = R * m.v_gyro;
  F.block<3, 3>(kV, kAccel) = R * m.v_accel;
  F.block<3, 3>(kV, kG) = dt * Matrix3d::Identity();
  Eigen::Matrix<double, kSize, 9> G = Eigen::Matrix<double, kSize, 9>::Zero();
  G.block<3, 3>(kT, 6) = m.R.transpose();
  G.block<3, 3>(kR, 0) = Matrix3d::Identity();
  G.block<3, 3>(kV, 3) = R;
  covariance = (F * covariance * F.transpose() + G * m.covariance * G.transpose()).eval();
  covariance.block<3, 3>(kGyro, kGyro) += dt * variance(noise.gyro_walk);
  covariance.block<3, 3>(kAccel, kAccel) += dt * variance(noise.accel_walk);

  stamp_s += dt;
  T_map_base.translation() += dt * velocity + 0.5 * dt * dt * gravity + R * m.p;
  T_map_base.linear() = R_next;
  velocity += dt * gravity + R * m.v;
}

double ImuFilter::distance(const Pose& measured, const Matrix6& pose_noise) const {
  const Twist y = se3_log(T_map_base.inverse() * measured);
  const Matrix6 S = covariance.topLeftCorner<6, 6>() + pose_noise;
  return y.dot(S.ldlt().solve(y));
}

void ImuFilter::correct(const Pose& measured, const Matrix6& pose_noise) {
  const Twist y = se3_log(T_map_base.inverse() * measured);
  const Eigen::LDLT<Matrix6> S(covariance.topLeftCorner<6, 6>() + pose_noise);
  const Eigen::Matrix<double, kSize, 6> gain = S.solve(covariance.topRows<6>()).transpose();
  const Error change = gain * y;
  Covariance keep = Covariance::Identity();
  keep.leftCols<6>() -= gain;
  covariance = (keep * covariance * keep.transpose() + gain * pose_noise * gain.transpose()).eval();
  T_map_base = orthonormalized((T_map_base * se3_exp(change.head<6>())).matrix());
  velocity += change.segment<3>(kV);
  bias.gyro += change.segment<3>(kGyro);
  bias.accel += change.segment<3>(kAccel);
  gravity += change.segment<3>(kG);
  keep_gravity_length();
}

void ImuFilter::correct_at_most(const Pose& measured, Matrix6 pose_noise, double gate) {
  slips = distance(measured, pose_noise) > gate ? slips + 1 : 0;
  constexpr int kMostDoublings = 60;  // noise that is zero stays zero
  for (int k = 0; k < kMostDoublings && distance(measured, pose_noise) > gate; ++k) pose_noise *= 2;
  correct(measured, pose_noise);
}

void ImuFilter::restart(double stamp_now_s, const Pose& measured, const Matrix6& pose_noise, const ImuStart& start) {
  stamp_s = stamp_now_s;
  T_map_base = measured;
  slips = 0;
  velocity.setZero();
  constexpr int n = kGyro;  // pose and velocity
  covariance.topRows<n>().setZero();
  covariance.leftCols<n>().setZero();
  covariance.topLeftCorner<6, 6>() = pose_noise;
  covariance.block<3, 3>(kV, kV) = variance(start.speed);
}

ImuFilter::Error ImuFilter::error_of(const ImuFilter& truth) const {
  Error e;
  e << se3_log(T_map_base.inverse() * truth.T_map_base), truth.velocity - velocity, truth.bias.gyro - bias.gyro,
      truth.bias.accel - bias.accel, across(gravity) * (truth.gravity - gravity);
  return e;
}

/// An error of gravity lies across it: its length is that of standard gravity.
void ImuFilter::keep_gravity_length() {
  gravity = kGravity * gravity.normalized();
  const Matrix3d flat = across(gravity);
  covariance.bottomRows<3>() = (flat * covariance.bottomRows<3>()).eval();
  covariance.rightCols<3>() = (covariance.rightCols<3>() * flat).eval();
}

void save(RecordWriter& out, const ImuFilter& f) {
  out.add(f.stamp_s);
  out.add(f.T_map_base);
  out.add(f.velocity);
  out.add(f.bias.gyro);
  out.add(f.bias.accel);
  out.add(f.gravity);
  out.add(f.covariance);
  out.add(f.slips);
}

void load(RecordReader& in, ImuFilter& f) {
  in.take(f.stamp_s);
  in.take(f.T_map_base);
  in.take(f.velocity);
  in.take(f.bias.gyro);
  in.take(f.bias.accel);
  in.take(f.gravity);
  in.take(f.covariance);
  in.take(f.slips);
}

}  // namespace ppm
