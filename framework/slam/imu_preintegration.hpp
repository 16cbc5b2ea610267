#pragma once
#include <optional>
#include <span>

#include "framework/slam/frame.hpp"

namespace ppm {

/// How much an inertial unit's signals differ from what they measure: densities of white noise, and of the random walks
/// of their biases.
struct ImuNoise {
  double gyro = 1e-3;        ///< rad/s/sqrt(Hz)
  double accel = 1e-2;       ///< m/s^2/sqrt(Hz)
  double gyro_walk = 1e-4;   ///< rad/s^2/sqrt(Hz)
  double accel_walk = 1e-3;  ///< m/s^3/sqrt(Hz)
};

/// What is taken off the signals.
struct ImuBias {
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   ///< rad/s
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  ///< m/s^2
};

/// The motion of a body from time i to time j as its inertial unit felt it, without gravity and without the velocity
/// that it began with:
///   R_j = R_i R          v_j = v_i + g dt + R_i v          p_j = p_i + v_i dt + g dt^2 / 2 + R_i p
/// Source: Forster, Carlone, Dellaert, Scaramuzza, "On-manifold preintegration for real-time visual-inertial odometry",
/// IEEE Transactions on Robotics 33(1), 2017.
struct ImuMotion {
  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  double dt = 0;  ///< s
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< m/s, axes of the body at i
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m, the same
  /// Of the errors (rotation: R exp(e), axes of the body at j; v; p) by the white noise of the samples.
  Matrix9 covariance = Matrix9::Zero();
  /// How R (as R exp(e)), v and p change with the biases.
  Eigen::Matrix3d R_gyro = Eigen::Matrix3d::Zero(), v_gyro = Eigen::Matrix3d::Zero(), v_accel = Eigen::Matrix3d::Zero(),
                  p_gyro = Eigen::Matrix3d::Zero(), p_accel = Eigen::Matrix3d::Zero();
  ImuBias bias;  ///< that were taken off

  /// Goes on by a step in which rate and force (of the signals, biases still in them) do not change. dt_s > 0.
  void add(const Eigen::Vector3d& gyro, const Eigen::Vector3d& accel, double dt_s, const ImuNoise& noise);
  /// The same samples with other biases, to first order.
  ImuMotion with_bias(const ImuBias& other) const;
};

/// The samples' motion from begin_s to end_s, begin_s < end_s. Between samples the signals are taken to be linear,
/// before the first and after the last to stay as they are; the middle of each step stands for it, so the error falls
/// with the square of the steps' length. samples: ascending, in (begin_s, end_s], not empty; before: the last sample
/// up to begin_s.
ImuMotion preintegrate(std::span<const ImuSample> samples, const std::optional<ImuSample>& before, double begin_s,
                       double end_s, const ImuBias& bias, const ImuNoise& noise);

}  // namespace ppm
