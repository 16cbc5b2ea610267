#include "framework/roles/motion_model.hpp"

#include "framework/core/error.hpp"

namespace ppm {

std::optional<PathVelocity> last_velocity(const Trajectory& path) {
  const Trajectory before = path.parent();
  if (before.empty()) return {};
  const double step_s = path.last().stamp_s - before.last().stamp_s;
  if (!(step_s > 0)) return {};
  return PathVelocity{se3_log(before.last().T_map_camera.inverse() * path.last().T_map_camera) / step_s, step_s};
}

MotionModel::MotionModel(const PoseNoise& noise) : noise_(noise) {
  noise_.declare(params_, "noise added in each frame");
}

void MotionModel::tick(Context& context) {
  const auto now = frame.get();
  auto& particles = *belief;
  context.workers().for_each(particles.size(), [&](std::size_t i, int) {
    PPM_CHECK(!particles.trajectory[i].empty(), "the first frame must have begun the path");
    const Pose predicted = predict(particles.trajectory[i], now->stamp_s);
    particles.extend(i, {now->index, now->stamp_s, predicted * noise_.draw(context.rng("noise", i))});
  });
}

}  // namespace ppm
