#pragma once
#include <optional>

#include "framework/graph/module.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// A rate of change of pose over one step of a path, in the camera's own frame.
struct PathVelocity {
  Twist per_s = Twist::Zero();
  double step_s = 0;  ///< length of the step
};
/// Of the last step of a path: log(T_{k-1}^-1 T_k) / dt. None where the path has one pose, or its last step took no time.
std::optional<PathVelocity> last_velocity(const Trajectory& path);

/// Base of motion models that move each particle by its own path alone: T_k = predict(path) exp(noise). Noise is that of
/// a step, whatever its length. Since a path is part of its particle, resampling moves it too.
class MotionModel : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives index and stamp of the new pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};
  void tick(Context& context) final;

 protected:
  /// noise: default of the parameters sigma_t and sigma_r.
  explicit MotionModel(const PoseNoise& noise);
  /// T_map_camera at a time after the path's last pose; the path is not empty. Called from any worker.
  virtual Pose predict(const Trajectory& path, double stamp_s) const = 0;

 private:
  PoseNoise noise_;
};

}  // namespace ppm
