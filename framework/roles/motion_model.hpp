#pragma once
#include <optional>

#include "framework/graph/module.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/motion_prior.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// A rate of change of pose over one step of a path, in the camera's own frame.
struct PathVelocity {
  Twist per_s = Twist::Zero();
  double step_s = 0;  ///< length of the step
};
/// Of the last step of a path: log(T_{k-1}^-1 T_k) / dt. None where the path has one pose, or its last step took no time.
std::optional<PathVelocity> last_velocity(const Trajectory& path);

/// Base of motion models: each particle's new pose is drawn from a Gaussian around what is expected of it, which stays
/// with the particle for nodes that look at the image before they choose (see MotionPrior). In a frame that the paths
/// already hold, the one that the map began with, nothing moves.
class MotionModel : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives index and stamp of the new pose, and what was measured on the way."};
  InOut<Belief> belief{this, {{"belief"}, {"motion.prior"}, {"prediction"}}};
  void tick(Context& context) final;

 protected:
  MotionModel() = default;
  /// Instead of a move, in the frame that the paths began with, where the node runs in it: what the model must know of it.
  virtual void begin(Context&) {}
  /// Before the particles are moved, from one thread: for work shared by all, and for the model's own columns.
  virtual void before(Context&) {}
  /// What is expected of a particle whose path, not empty, ends with the frame before. Called from any worker; may change
  /// the particle's entries in columns of the model's own.
  virtual MotionPrior expect(std::size_t particle, const Trajectory& path, const Frame& now) = 0;
};

/// Base of motion models that know a particle's own path alone: T_k = predict(path) exp(noise). Since a path is part of its
/// particle, resampling moves it too.
///
/// The noise is given (sigma_t, sigma_r), or learnt: each step's standard deviations are then those of the model's own
/// errors over the path's last `noise_steps` steps, with the given ones as a prior that counts for `noise_prior` steps.
/// A camera that moves steadily is followed closely, one that is shaken widely, whatever the rate of its frames.
class PathMotion : public MotionModel {
 protected:
  /// noise: default of the parameters sigma_t and sigma_r.
  explicit PathMotion(const PoseNoise& noise);
  /// T_map_camera at a time after the path's last pose; the path is not empty. Called from any worker.
  virtual Pose predict(const Trajectory& path, double stamp_s) const = 0;
  MotionPrior expect(std::size_t particle, const Trajectory& path, const Frame& now) final;

 private:
  /// Of one step at noise_rate.
  PoseNoise learnt(const Trajectory& path) const;
  /// How much larger the noise of a step is than that of one at noise_rate.
  double growth(double step_s) const;

  PoseNoise noise_;
  int noise_steps_ = 0;
  double noise_prior_ = 2, noise_scale_ = 1, noise_rate_hz_ = 0;
};

}  // namespace ppm
