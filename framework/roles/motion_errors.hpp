#pragma once
#include <string>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/motion_prior.hpp"

namespace ppm {

/// One step of a motion model along a path that is known.
struct MotionError {
  Twist error = Twist::Zero();  ///< the true pose against the one foretold: m, rad, axes of the camera
  double log_density = 0;       ///< of the true pose, by what the model expected
  double mahalanobis = 0;       ///< squared, of error by what the model expected: 6 on average where its noise is right
  Pose T_body_step = Pose::Identity();  ///< what odometry says of the step; identity without
  Twist body_error = Twist::Zero();     ///< the error as a twist of the body
};

/// What a motion model (a MotionModel of the registry, "motion.x", with parameters as YAML) foretells at each frame of a
/// path, being told the true pose of the frames before. frames: without images; each has a reference pose, and its imu is of
/// the way from the frame before. The first two steps are left out: no model foresees a start. Throws what the model throws.
std::vector<MotionError> motion_errors(const Registry& registry, const std::string& model,
                                       const std::string& params_yaml, const std::vector<Frame>& frames);

/// Every n-th frame, from frame `phase` on, each with the inertial samples of all the way from the one before.
std::vector<Frame> every_nth(const std::vector<Frame>& frames, std::size_t n, std::size_t phase);

/// Errors of a model in numbers.
struct MotionErrorSummary {
  std::size_t steps = 0;
  Twist rms = Twist::Zero();              ///< along and about each axis of the camera: m, rad
  double sigma_t = 0, sigma_r = 0;        ///< deviation of an axis, m, rad: what a PoseNoise should be
  double translation_95 = 0, rotation_95 = 0;  ///< lengths that 95 % of the errors do not exceed, m, rad
  double consistency = 0;                 ///< mean squared Mahalanobis distance, by 6: 1 where the noise is right
};
MotionErrorSummary summary(const std::vector<MotionError>& errors);

/// Noise of odometry that grows with the step: deviation of an axis = least + per_m * length + per_rad * turn.
struct GrowingNoise {
  double least = 0, per_m = 0, per_rad = 0;
};
/// Fitted to the errors' translations (m) or rotations (rad), none of the three negative.
GrowingNoise fit_growing_noise(const std::vector<MotionError>& errors, bool rotation);

/// The parameters with some of them, positive numbers in SI units, changed so that the true poses are as likely as can be: a
/// search from the given values, factor by factor.
Config likeliest(const Registry& registry, const std::string& model, Config params,
                 const std::vector<std::string>& keys, const std::vector<Frame>& frames);

}  // namespace ppm
