#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/motion_model.hpp"

namespace {

using namespace ppm;

/// Moves each particle with a velocity that changes as it changed last: T_k = T_{k-1} exp(dt_k * v_k) exp(noise). A step's
/// velocity (a twist in the camera frame) is that of its middle, so with the last two steps' v_1, v_2 and lengths
/// dt_1, dt_2 the acceleration is (v_2 - v_1) / ((dt_1 + dt_2) / 2), and v_k = v_2 + decay * acceleration *
/// (dt_2 + dt_k) / 2. A path of two poses has no acceleration yet, one of one pose no velocity.
///
/// source  paper, section 4.1
class ConstantAcceleration final : public PathMotion {
 public:
  ConstantAcceleration() : PathMotion({0.02, std::numbers::pi / 180}) {
    params_.add("acceleration_decay", acceleration_decay_)
        .range(0, 1)
        .doc("Share of the acceleration that is kept: 1 is constant acceleration, 0 constant velocity.");
  }

 private:
  Pose predict(const Trajectory& path, double stamp_s) const override {
    const auto& last = path.last();
    const auto velocity = last_velocity(path);
    if (!velocity) return last.T_map_camera;
    const double dt = stamp_s - last.stamp_s;
    Twist v = velocity->per_s;
    if (const auto before = last_velocity(path.parent())) {
      const Twist acceleration = (v - before->per_s) / (0.5 * (before->step_s + velocity->step_s));
      v += acceleration_decay_ * 0.5 * (velocity->step_s + dt) * acceleration;
    }
    return last.T_map_camera * se3_exp(dt * v);
  }

  double acceleration_decay_ = 1.0;
};

}  // namespace

PPM_MODULES(r) {
  r.add<ConstantAcceleration>("motion.constant_acceleration",
                              "Moves each particle with the velocity and acceleration of its own path, plus noise.",
                              "paper, section 4.1; Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 5");
}
