#include "framework/graph/registry.hpp"
#include "framework/roles/settle_poses.hpp"
#include "framework/roles/twins.hpp"
#include "modules/motion/icp_alignment.hpp"

namespace {

using namespace ppm;

/// The paper's other way to a pose: each particle's frame is registered to the points of its own map, from where the motion
/// model expects it; its pose is the optimum, or a draw from the Gaussian around it, weighed by the motion prior.
/// Directions that the points do not hold (along a bare wall) are left to the prior. A particle whose registration fails keeps
/// the pose that the motion model drew.
///
/// frame    depth, sigma
/// belief   map.points; needs the motion's prior (a motion.* node above), gives new poses and weights
///
/// metrics  failed (share of the particles that kept the prior's draw), outliers and inliers (shares, of the first particle
///          with the most inliers), trees (of tiles that changed, built in this frame)
///
/// source  paper, section 2.1; Besl, McKay, PAMI 1992; Chen, Medioni, IVC 1992; Rusinkiewicz, Levoy, 3DIM 2001
class IcpMotion final : public Module {
 public:
  In<Frame> frame{this, "frame", "The image that is registered."};
  InOut<Belief> belief{this, {{"map.points", "motion.prior"}, {}, {"prediction"}}};

  IcpMotion() {
    icp_.declare(params_);
    params_.add_choice("draw", draw_, {{"optimum", Draw::optimum}, {"sample", Draw::sample}})
        .doc("The new pose: optimum takes the optimum, sample draws it from the Gaussian around it.");
    params_.add("outliers_lost", outliers_lost_)
        .range(0, 1)
        .doc(
            "A registration that leaves a larger share of the pixels near the map farther than 3 sigma + 1 cm from it is no "
            "better than none.");
    params_.add("inliers_least", inliers_least_)
        .range(0, 1)
        .doc("Nor is one that explains a smaller share of the measured pixels.");
  }

  void tick(Context& context) override {
    auto& particles = *belief;
    icp_.begin(*frame.get());
    scratch_.resize(context.threads());
    indexes_.update(distinct_maps(particles), context.workers());
    found_.assign(particles.size(), {});
    align_all(context);
    std::vector<const Alignment*> usable;
    for (const auto& at : found_) usable.push_back(is_usable(at.fit) ? &at : nullptr);
    const auto log_prior = [&](std::size_t i, const Pose& T) { return prior(i).log_density(T); };
    settle_poses(particles, usable, draw_, log_prior, context);
    record(context, usable);
  }

 private:
  const MotionPrior& prior(std::size_t i) const { return belief->column<MotionPrior>(kMotionPriorColumn)[i]; }
  bool is_usable(const AlignmentFit& fit) const {
    return fit.outlier_share() <= outliers_lost_ && fit.inlier_share() >= inliers_least_;
  }

  /// Particles that share map and the prior's mean are aligned once.
  void align_all(Context& context) {
    std::vector<Pose> means;
    for (std::size_t i = 0; i < belief->size(); ++i) means.push_back(prior(i).T_map_camera);
    const auto leader = twins(*belief, means);
    context.workers().for_each(leader.size(), [&](std::size_t i, int worker) {
      if (leader[i] != i) return;
      const PointFinder finder = indexes_.of(static_cast<const PointMap&>(*belief->map[i]));
      found_[i] = icp_.align(finder, prior(i), means[i], scratch_[worker]);
    });
    for (std::size_t i = 0; i < leader.size(); ++i) found_[i] = found_[leader[i]];
  }

  void record(Context& context, const std::vector<const Alignment*>& usable) {
    const auto best = std::ranges::max_element(found_, {}, [](const auto& at) { return at.fit.inlier_share(); });
    context.metric("failed", static_cast<double>(std::ranges::count(usable, nullptr)) / static_cast<double>(usable.size()));
    context.metric("outliers", best->fit.outlier_share());
    context.metric("inliers", best->fit.inlier_share());
    context.metric("trees", static_cast<double>(indexes_.built()));
  }

  IcpAlignment icp_;
  Draw draw_ = Draw::optimum;
  double outliers_lost_ = 0.4, inliers_least_ = 0.15;
  PointIndexes indexes_;
  std::vector<Alignment> found_;  // of one frame
  PerWorker<IcpAlignment::Scratch> scratch_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<IcpMotion>("motion.icp", "Registers each particle's frame to the points of its own map by iterating closest points.",
                   "paper, section 2.1; Besl, McKay, PAMI 1992; Chen, Medioni, IVC 1992; Rusinkiewicz, Levoy, 3DIM 2001");
}
