#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/motion/pose_noise.hpp"

namespace ppm {
namespace {

/// Puts each particle at the frame's reference pose, for mapping with known poses. The map frame is then the
/// reference's own: the map must start there (`start: reference`). throws  DataError where the frame has no reference
/// pose
class ReferencePose final : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives the pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  ReferencePose() { noise_.declare(params_); }

  void tick(Context& context) override {
    const auto now = frame.get();
    if (!now->T_world_camera_ref)
      throw DataError("the source", now->index, "the image has no reference pose to map with");
    auto& particles = *belief;
    const Pose exact = *now->T_world_camera_ref;
    context.workers().for_each(particles.size(), [&](std::size_t i, int) {
      particles.extend(i, {now->index, now->stamp_s, exact * noise_.draw(context.rng("noise", i))});
    });
  }

 private:
  PoseNoise noise_{0, 0};
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::ReferencePose>("motion.reference_pose",
                            "Puts each particle at the data set's reference pose, plus noise if asked.",
                            "mapping with known poses");
}
