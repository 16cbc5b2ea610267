#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/motion_model.hpp"

namespace {

using namespace ppm;

/// Moves each particle on as it moved last: T_k = T_{k-1} exp(decay * dt_k * velocity) exp(noise). The velocity is a
/// twist in the camera frame, over the path's last step; the stamps count, so frames may be skipped or held out. A path
/// of one pose has no velocity yet.
///
/// source  paper, section 4.1
class ConstantVelocity final : public PathMotion {
 public:
  ConstantVelocity() : PathMotion({0.02, std::numbers::pi / 180}) {
    params_.add("velocity_decay", velocity_decay_)
        .range(0, 1)
        .doc("Share of the velocity that is kept: 1 is constant velocity, 0 a random walk.");
  }

 private:
  Pose predict(const Trajectory& path, double stamp_s) const override {
    const auto& last = path.last();
    const auto velocity = last_velocity(path);
    if (!velocity) return last.T_map_camera;
    return last.T_map_camera * se3_exp(velocity_decay_ * (stamp_s - last.stamp_s) * velocity->per_s);
  }

  double velocity_decay_ = 1.0;
};

}  // namespace

PPM_MODULES(r) {
  r.add<ConstantVelocity>("motion.constant_velocity",
                          "Moves each particle with the velocity of its own path, plus noise.",
                          "paper, section 4.1; Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 5");
}
