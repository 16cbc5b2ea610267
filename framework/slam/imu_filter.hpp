#pragma once
#include "framework/slam/imu_preintegration.hpp"
#include "framework/slam/motion_prior.hpp"

namespace ppm {

/// What is not known when an inertial unit begins to be followed: standard deviations.
struct ImuStart {
  double speed = 0.2;        ///< m/s, of the body, along each axis
  double accel = 0.3;        ///< m/s^2, of the body: it tilts the vertical that is taken from the first samples
  double gyro_bias = 0.02;   ///< rad/s
  double accel_bias = 0.1;   ///< m/s^2
};

/// Where a body is by its inertial unit, and what must be known to go on from there, given the poses at which a filter
/// put it on its way: a Gaussian. Poses are measurements of where the body is, with an error of their own.
/// Errors, of the truth against the estimate, in this order, 3 each: translation and rotation (a twist at the right of
/// the pose, axes of the body), velocity (map), bias of rate, bias of force, gravity (map; its length is known, so two of
/// the three directions count).
class ImuFilter {
 public:
  static constexpr int kSize = 18;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;
  using Error = Eigen::Matrix<double, kSize, 1>;
  static constexpr double kGravity = 9.80665;  ///< m/s^2

  double stamp_s = 0;  ///< of the estimate
  Pose T_map_base = Pose::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, map frame
  ImuBias bias;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s^2, map frame; zero where the filter has not begun
  Covariance covariance = Covariance::Zero();
  int slips = 0;  ///< poses in a row beyond the gate of correct_at_most()

  bool begun() const { return !gravity.isZero(); }
  /// At rest as far as is known, gravity along the mean force of some samples taken about there. pose_noise: of the pose,
  /// as a twist of the body. Needs samples whose mean force is not zero.
  void begin(double stamp_now_s, const Pose& T_map_base_now, std::span<const ImuSample> samples,
             const Matrix6& pose_noise, const ImuStart& start);
  /// Goes on by a motion, whatever biases were taken off it.
  void predict(const ImuMotion& motion, const ImuNoise& noise);
  /// Squared Mahalanobis distance between where the body was put and the prediction, of 6 degrees of freedom. pose_noise:
  /// covariance of the former, as a twist of the body.
  double distance(const Pose& measured, const Matrix6& pose_noise) const;
  /// Learns from where the body was put.
  void correct(const Pose& measured, const Matrix6& pose_noise);
  /// Learns from a pose beyond the distance `gate` as much as if its noise were so large that it is not: an alignment that
  /// slipped says little of velocity. Counts slips.
  void correct_at_most(const Pose& measured, Matrix6 pose_noise, double gate);
  /// Where the body was moved in a way that no motion explains: the pose is taken as it is, and the velocity is as
  /// unknown as at the start. Biases and gravity stay.
  void restart(double stamp_now_s, const Pose& measured, const Matrix6& pose_noise, const ImuStart& start);
  /// The truth against this estimate.
  Error error_of(const ImuFilter& truth) const;

 private:
  void keep_gravity_length();
};
void save(RecordWriter& out, const ImuFilter& filter);
void load(RecordReader& in, ImuFilter& filter);

}  // namespace ppm
