#pragma once
#include "framework/core/record.hpp"
#include "framework/core/se3.hpp"

namespace ppm {

/// Covariance or information of a twist: translation first.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What a motion model expects of a particle's pose in this frame, before the image is looked at: T = T_map_camera
/// exp(xi), xi ~ N(0, covariance).
struct MotionPrior {
  Pose T_map_camera = Pose::Identity();
  Matrix6 covariance = Matrix6::Zero();  ///< m^2, rad^2; symmetric, positive semidefinite

  /// xi of a pose, and its log density. A covariance without an inverse is given a floor of (1 um)^2, (1 urad)^2.
  Twist offset(const Pose& T) const { return se3_log(T_map_camera.inverse() * T); }
  double log_density(const Pose& T) const;
  /// Inverse of the covariance, with the same floor.
  Matrix6 information() const;
};
void save(RecordWriter& out, const MotionPrior& prior);
void load(RecordReader& in, MotionPrior& prior);

/// The column of a belief that holds each particle's MotionPrior of this frame; with it goes the facet "motion.prior".
constexpr const char* kMotionPriorColumn = "motion.prior";

/// The column (Matrix6) of what the image alone said of each particle's pose in this frame, where a node laid one onto the
/// other: information of the pose's twist, 1/m^2, 1/rad^2; zero where it said nothing. Motion models learn from no more.
constexpr const char* kMotionSeenColumn = "motion.seen";

}  // namespace ppm
