#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "framework/roles/pose_noise.hpp"

namespace ppm {
namespace {

/// Puts each particle at the frame's reference pose, for mapping with known poses: in the map frame, wherever the map
/// started (belief.T_map_world).
/// throws  DataError where the frame has no reference pose, or the first frame had none: the map's place is not known
class ReferencePose final : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives the pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  ReferencePose() { noise_.declare(params_, "noise added in each frame"); }

  void tick(Context& context) override {
    const auto now = frame.get();
    if (!now->T_world_camera_ref)
      throw DataError("the source", now->index, "the image has no reference pose to map with");
    auto& particles = *belief;
    if (!particles.T_map_world)
      throw DataError("the source", now->index,
                      "the frame that the map started at has no reference pose, so this one's place in the map is not known");
    const Pose exact = *particles.T_map_world * *now->T_world_camera_ref;
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
