#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "framework/roles/pose_noise.hpp"

namespace ppm {
namespace {

/// Moves each particle on as it moved last: T_k = T_{k-1} exp(decay * dt_k / dt_{k-1} * log(T_{k-2}^-1 T_{k-1}))
/// exp(noise). The velocity is a twist in the camera frame, from the particle's own path, so resampling moves it too.
/// The ratio of the stamps' distances stands for frames that were skipped or held out. A path of one pose has no
/// velocity yet. Noise is that of a step, whatever its length.
class ConstantVelocity final : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives index and stamp of the new pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  ConstantVelocity() {
    noise_.declare(params_, "noise added in each frame");
    params_.add("velocity_decay", velocity_decay_)
        .range(0, 1)
        .doc("Share of the velocity that is kept: 1 is constant velocity, 0 a random walk.");
  }

  void tick(Context& context) override {
    const auto now = frame.get();
    auto& particles = *belief;
    context.workers().for_each(particles.size(), [&](std::size_t i, int) {
      const Pose predicted = advance(particles.trajectory[i], now->stamp_s);
      particles.extend(i, {now->index, now->stamp_s, predicted * noise_.draw(context.rng("noise", i))});
    });
  }

 private:
  Pose advance(const Trajectory& path, double stamp_s) const {
    PPM_CHECK(!path.empty(), "the first frame must have begun the path");
    const auto& last = path.last();
    const auto before = path.parent();
    if (before.empty()) return last.T_map_camera;
    const double ratio = (stamp_s - last.stamp_s) / (last.stamp_s - before.last().stamp_s);
    const Twist velocity = se3_log(before.last().T_map_camera.inverse() * last.T_map_camera);
    return last.T_map_camera * se3_exp(velocity_decay_ * ratio * velocity);
  }

  PoseNoise noise_{0.02, std::numbers::pi / 180};
  double velocity_decay_ = 1.0;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::ConstantVelocity>("motion.constant_velocity",
                               "Moves each particle with the velocity of its own path, plus noise.",
                               "paper, section 4.1; Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 5");
}
