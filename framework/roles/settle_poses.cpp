#include "framework/roles/settle_poses.hpp"

#include <algorithm>

#include "framework/roles/pose_noise.hpp"

namespace ppm {

void settle_poses(ParticleSet& particles, const std::vector<const Alignment*>& at, Draw draw,
                  const std::function<double(std::size_t, const Pose&)>& log_prior, Context& context) {
  PPM_CHECK(at.size() == particles.size(), "{} alignments of {} particles", at.size(), particles.size());
  const auto& prior = particles.column<MotionPrior>(kMotionPriorColumn);
  auto& seen = particles.column<Matrix6>(kMotionSeenColumn);
  context.workers().for_each(particles.size(), [&](std::size_t i, int) {
    seen[i].setZero();
    if (!at[i]) return;
    seen[i] = at[i]->information - prior[i].information();
    const Twist z = draw == Draw::sample ? normal_twist(context.rng("draw", i)) : Twist::Zero();
    const PoseDraw drawn = draw_around(*at[i], z);
    particles.correct(i, drawn.T_map_camera);
    particles.log_weight[i] += log_prior(i, drawn.T_map_camera) - drawn.log_density;
  });
  // A draw of the prior's own leaves the weight as it is, which is on another scale than a peak's: where some particles
  // were aligned, those that were not have to be worse.
  double least = 0;
  bool any = false;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!at[i]) continue;
    least = any ? std::min(least, particles.log_weight[i]) : particles.log_weight[i];
    any = true;
  }
  if (!any) return;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!at[i]) particles.log_weight[i] = std::min(particles.log_weight[i], least);
  particles.normalize();
}

}  // namespace ppm
