#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "framework/graph/registry.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/roles/settle_poses.hpp"
#include "framework/roles/twins.hpp"
#include "framework/roles/view_aligner.hpp"

namespace {

using namespace ppm;

/// A proposal that looks first: each particle's frame is laid onto the view that its own map predicts where the motion
/// model expects it, its pose is drawn from the Gaussian around the optimum, and its weight takes the density of the motion
/// prior over that of the draw. Directions that the view does not hold (along a bare wall) keep the prior's spread.
///
/// Where no particle's view explains the frame after that, the particle with the largest weight is started anew from many
/// draws of its prior, wider stage by stage, all aligned coarsely to one view; each place found is refined on a view of its
/// own; what explains the frame then becomes a particle each, and shows the others the way. A particle whose alignment
/// fails all the same keeps the pose that the motion model drew.
///
/// frame    depth, sigma
/// belief   needs the motion's prior (a motion.* node above), gives new poses and weights; may add particles (a resampling
///          node with a fixed or adaptive number takes them back)
///
/// metrics  failed (share of the particles that kept the prior's draw), outliers and inliers (shares, of the best
///          alignment), starts (made in search of a place), places (found by them)
///
/// source  Montemerlo et al., "FastSLAM 2.0", IJCAI 2003; Grisetti, Stachniss, Burgard, T-RO 2007
class AlignedMotion final : public Module {
 public:
  In<Frame> frame{this, "frame", "The image that is laid onto the views."};
  Use<ViewPredictor> view{this, "view", "Predicts the views."};
  InOut<Belief> belief{this, {{"belief", "motion.prior"}, {}, {"prediction"}}};

  AlignedMotion() {
    aligner_.declare(params_);
    aligner_.declare_limits(params_);
    params_.add_choice("draw", draw_, {{"sample", Draw::sample}, {"optimum", Draw::optimum}})
        .doc("The new pose: sample draws it from the Gaussian around the optimum, optimum takes the optimum.");
    params_.add("starts", starts_)
        .range(1, 10000)
        .doc("Starts of the first stage of the search where no view explains the frame; each further stage makes twice as many.");
    params_.add("stages", stages_).range(0, 12).doc("Stages of that search; 0: none.");
    params_.add("start_scale", start_scale_)
        .range(0.1, 100)
        .doc("The starts of the first stage spread so much wider than the motion prior; each further stage twice as wide.");
    params_.add("start_sigma_t", start_sigma_t_)
        .unit("m")
        .range(0, 10)
        .doc("And at least so widely in translation in the first stage; each further stage twice as wide.");
    params_.add("start_sigma_r", start_sigma_r_)
        .unit("rad")
        .range(0, std::numbers::pi)
        .doc("And in rotation.");
    params_.add("places_most", places_most_).range(1, 1000).doc("Most places of a stage that are looked at closely.");
    params_.add("tail_share", tail_share_)
        .range(0, 1)
        .doc("Share of the motions that the prior's Gaussian does not know: they follow the spread of the first stage.");
  }

  void tick(Context& context) override {
    const auto now = frame.get();
    auto& particles = *belief;
    aligner_.begin(*now);
    scratch_.resize(context.threads());
    view->prepare(distinct_maps(particles), context.workers());
    found_.assign(particles.size(), {});
    starts_made_ = 0;
    const auto leader = align_all(context);
    std::size_t places_found = 0;
    if (stages_ > 0 && none_explains()) places_found = search(context, leader);
    follow(leader, context);
    settle(context);
    record(context, places_found);
  }

 private:
  /// What alignment found for a particle.
  struct Found {
    Alignment at;
    bool explains = false;  ///< the frame, well
    bool usable = false;    ///< well enough to be better than the prior alone
  };

  const MotionPrior& prior(std::size_t i) const { return belief->column<MotionPrior>(kMotionPriorColumn)[i]; }

  /// From the prior's mean of each particle; particles that share map and mean are aligned once. Returns for each particle
  /// the one that was.
  std::vector<std::size_t> align_all(Context& context) {
    std::vector<Pose> means;
    for (std::size_t i = 0; i < belief->size(); ++i) means.push_back(prior(i).T_map_camera);
    const auto leader = twins(*belief, means);
    context.workers().for_each(leader.size(), [&](std::size_t i, int worker) {
      if (leader[i] == i) found_[i] = align(i, prior(i).T_map_camera, worker);
    });
    for (std::size_t i = 0; i < leader.size(); ++i) found_[i] = found_[leader[i]];
    return leader;
  }

  /// The close manner first: it is exact where the start is near. The wide one where that does not explain the frame.
  Found align(std::size_t i, const Pose& start, int worker) {
    auto& scratch = scratch_[worker];
    const Map& map = *belief->map[i];
    const Found close = judged(aligner_.align(*view, map, prior(i), start, ViewAligner::Manner::close, scratch, worker));
    if (close.explains) return close;
    const Found wide =
        judged(aligner_.align(*view, map, widened(i, 0), start, ViewAligner::Manner::wide, scratch, worker));
    return wide.explains || wide.at.fit.outlier_share() < close.at.fit.outlier_share() ? wide : close;
  }

  Found judged(const Alignment& at) const { return {at, aligner_.explains(at.fit), aligner_.usable(at.fit)}; }

  /// The prior of a stage's starts.
  MotionPrior widened(std::size_t i, int stage) const {
    const double wider = std::ldexp(1.0, stage);
    MotionPrior out = prior(i);
    out.covariance *= std::pow(wider * start_scale_, 2);
    out.covariance += PoseNoise{wider * start_sigma_t_, wider * start_sigma_r_}.covariance();
    return out;
  }

  bool none_explains() const { return std::ranges::none_of(found_, &Found::explains); }

  /// Starts anew until something explains the frame. Returns the number of places that do.
  std::size_t search(Context& context, const std::vector<std::size_t>& leader) {
    const std::size_t parent = leader[belief->best()];
    aligner_.look(*view, *belief->map[parent], prior(parent).T_map_camera, shared_, 0);
    std::vector<Alignment> explaining;
    for (int stage = 0; stage < stages_ && explaining.empty(); ++stage)
      explaining = explaining_places(context, parent, widened(parent, stage), static_cast<std::size_t>(starts_) << stage);
    if (!explaining.empty()) adopt(parent, explaining);
    return explaining.size();
  }

  /// Of one stage: draws of the widened prior, their places, and what of those explains the frame when looked at closely.
  std::vector<Alignment> explaining_places(Context& context, std::size_t parent, const MotionPrior& wide, std::size_t starts) {
    const auto most = static_cast<std::size_t>(places_most_);
    auto places = distinct_places(align_starts(context, wide, starts), most);
    context.workers().for_each(places.size(), [&](std::size_t k, int worker) {
      places[k] = aligner_.align(*view, *belief->map[parent], wide, places[k].T_map_camera, ViewAligner::Manner::wide,
                                 scratch_[worker], worker);
    });
    std::erase_if(places, [&](const Alignment& at) { return !aligner_.explains(at.fit); });
    return distinct_places(std::move(places), most);
  }

  std::vector<Alignment> align_starts(Context& context, const MotionPrior& wide, std::size_t starts) {
    const Matrix6 root = wide.covariance.llt().matrixL();
    std::vector<Alignment> coarse(starts);
    context.workers().for_each(starts, [&](std::size_t k, int) {
      const Twist z = normal_twist(context.rng("start", starts_made_ + k));
      coarse[k] = aligner_.align_coarsely(shared_.view, wide, wide.T_map_camera * se3_exp(root * z));
    });
    starts_made_ += starts;
    return coarse;
  }

  /// The parent takes the likeliest place, a copy of it each other one.
  void adopt(std::size_t parent, const std::vector<Alignment>& found) {
    std::vector<std::uint32_t> ancestors(belief->size());
    std::iota(ancestors.begin(), ancestors.end(), 0u);
    ancestors.resize(belief->size() + found.size() - 1, static_cast<std::uint32_t>(parent));
    belief->gather(ancestors);
    found_.resize(belief->size());
    found_[parent] = judged(found.front());
    for (std::size_t k = 1; k < found.size(); ++k) found_[belief->size() - found.size() + k] = judged(found[k]);
  }

  /// Particles that found nothing try the motion of the likeliest that did.
  void follow(const std::vector<std::size_t>& leader, Context& context) {
    std::size_t guide = belief->size();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!found_[i].explains) continue;
      if (guide == belief->size() || found_[i].at.likelihood > found_[guide].at.likelihood) guide = i;
    }
    if (guide == belief->size()) return;
    const Pose motion = prior(guide).T_map_camera.inverse() * found_[guide].at.T_map_camera;
    context.workers().for_each(leader.size(), [&](std::size_t i, int worker) {
      if (leader[i] == i && !found_[i].explains) found_[i] = align(i, prior(i).T_map_camera * motion, worker);
    });
    for (std::size_t i = 0; i < leader.size(); ++i)
      if (!found_[i].explains) found_[i] = found_[leader[i]];
  }

  /// Each particle's draw and weight.
  void settle(Context& context) {
    std::vector<const Alignment*> usable;
    for (const auto& f : found_) usable.push_back(f.usable ? &f.at : nullptr);
    settle_poses(*belief, usable, draw_, [&](std::size_t i, const Pose& T) { return log_prior(i, T); }, context);
  }

  double log_prior(std::size_t i, const Pose& T) const {
    const double known = prior(i).log_density(T);
    if (tail_share_ == 0) return known;
    const double tail = widened(i, 0).log_density(T) + std::log(tail_share_);
    if (tail_share_ == 1) return tail;
    const double body = known + std::log1p(-tail_share_), larger = std::max(body, tail);
    return larger + std::log(std::exp(body - larger) + std::exp(tail - larger));
  }

  void record(Context& context, std::size_t places_found) {
    const Found* best = &found_.front();
    double failed = 0;
    for (const auto& f : found_) {
      failed += f.usable ? 0 : 1;
      if (f.explains && (!best->explains || f.at.likelihood > best->at.likelihood)) best = &f;
    }
    context.metric("failed", failed / static_cast<double>(found_.size()));
    context.metric("outliers", best->at.fit.outlier_share());
    context.metric("inliers", best->at.fit.inlier_share());
    context.metric("starts", static_cast<double>(starts_made_));
    context.metric("places", static_cast<double>(places_found));
  }

  ViewAligner aligner_;
  Draw draw_ = Draw::sample;
  int starts_ = 20, stages_ = 4, places_most_ = 6;
  double start_scale_ = 2, start_sigma_t_ = 0.02, start_sigma_r_ = 1.5 * std::numbers::pi / 180, tail_share_ = 0.1;

  // Of one frame.
  std::vector<Found> found_;
  std::size_t starts_made_ = 0;
  PerWorker<AlignScratch> scratch_;
  AlignScratch shared_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<AlignedMotion>("motion.aligned",
                       "Lays each particle's frame onto its own predicted view and draws the pose around the optimum.",
                       "Montemerlo et al., \"FastSLAM 2.0\", IJCAI 2003; Grisetti, Stachniss, Burgard, T-RO 2007");
}
