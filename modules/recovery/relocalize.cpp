#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/core/data_path.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/roles/view_aligner.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/recovery/known_places.hpp"
#include "modules/recovery/loss_watch.hpp"
#include "modules/recovery/place_search.hpp"

namespace {

using namespace ppm;

/// Where each particle stood when the camera was last known to be there.
constexpr const char* kAnchorColumn = "recovery.anchor";

/// Notices when no particle explains what the camera sees, says so, keeps the maps from learning from it, and searches for
/// the camera: around where it was last, ever wider, and after a few frames at the places from which the map has been
/// seen, those first that look most like the frame. Each is tried by aligning the frame to what the map shows there. Where
/// that explains the frame, all particles start anew there, as copies of the one whose map was searched; when they have held
/// the place for a few frames, the camera is found.
///
/// A wrong place may explain much of a frame (floor, a wall). So after some frames that are explained, but not well, known places are
/// tried too, and particles and maps left as they are unless another place explains the frame.
///
/// While nothing is found the particles stand around their last sure poses, ever wider, with even weights; the run goes on, and
/// the maps stay as they were. A camera that is carried to a place that the map does not have stays lost.
///
/// The belief may come lost already (map.ppm_file with `start: unknown`): then the search is the global one from the first
/// frame on, and `path` must say from where the map has been seen.
///
/// frame    the image that the views did or did not explain
/// belief   needs fits (a weighting.* node above); sets lost; column "recovery.anchor", a Pose a particle. Poses, weights
///          and paths' last entries change where the camera is lost
///
/// metrics  lost (1 from the frame that the loss is declared in until the camera is found), unexplained (1 in a frame that no
///          particle explains; no map learns from it), explained (share of the compared pixels, of the particle that explains
///          most), places (known ones, while lost), tried, accepted
/// throws   ConfigError where the place is unknown from the start and `path` is not given
///
/// source  Thrun, Burgard, Fox, "Probabilistic Robotics", section 8.3.3 (recovery from failures); Milford, Wyeth, "SeqSLAM",
///         ICRA 2012 (places as tiny images)
class Relocalize final : public Module {
 public:
  In<Frame> frame{this, "frame", "The measured image."};
  Use<ViewPredictor> view{this, "view", "Predicts what the map shows from a place."};
  InOut<Belief> belief{this, {{"belief", "fit"}, {}, {"prediction"}}};

  Relocalize() {
    watch_.declare(params_);
    params_.add("path", path_)
        .doc(
            "Poses from which the map was seen, beside those of this run: a file in TUM format, or the folder of a run that holds "
            "one as trajectory.tum. Relative to the current directory; ${PPM_DATA} may stand first.");
    places_.declare(params_);
    search_.declare(params_);
    aligner_.declare(params_);
  }

  void open(Context&) override {
    if (path_.empty()) return;
    const auto path = expand_data_path(path_);
    given_path_ = read_tum(std::filesystem::is_directory(path) ? path / "trajectory.tum" : path);
  }

  void tick(Context& context) override {
    const auto& fits = belief->column<ViewFit>(kViewFitColumn).values;
    found_.clear();
    tried_ = 0;
    const auto before = watch_.phase();
    const bool came_lost = belief->lost && !said_lost_;
    if (!belief->lost && sure_frame_ < 0) remember_start(context);
    if (came_lost)
      watch_.lose();
    else
      watch_.next(fits);
    const auto phase = watch_.phase();
    if (phase == LossWatch::Phase::lost && before == LossWatch::Phase::tracked) declare_loss(context);
    if (phase == LossWatch::Phase::lost) search(context);
    if (watch_.doubted()) look_elsewhere(context);
    if (phase == LossWatch::Phase::returning && before == LossWatch::Phase::lost) rest(context);
    if (phase == LossWatch::Phase::tracked && before == LossWatch::Phase::returning) declare_found(context);
    if (watch_.sure()) remember(context);
    belief->lost = said_lost_ = watch_.phase() != LossWatch::Phase::tracked ||
                                watch_.verdict() == LossWatch::Verdict::unexplained;
    record(context);
  }

  void save(RecordWriter& out) const override {
    watch_.save(out);
    places_.save(out);
    out.add(said_lost_);
    out.add(sure_frame_);
    out.add(lost_since_);
  }
  void load(RecordReader& in) override {
    watch_.load(in);
    places_.load(in);
    in.take(said_lost_);
    in.take(sure_frame_);
    in.take(lost_since_);
  }

 private:
  Column<Pose>& anchors() { return belief->column<Pose>(kAnchorColumn); }

  void remember(Context& context) {
    anchors().values = belief->pose;
    sure_frame_ = context.frame();
  }

  /// A belief that did not come lost knows where its path begins, even where no frame after it is explained.
  void remember_start(Context& context) {
    for (std::size_t i = 0; i < belief->size(); ++i) {
      const Trajectory before = belief->trajectory[i].parent();
      if (before.empty()) return;
      anchors()[i] = before.last().T_map_camera;
    }
    sure_frame_ = context.frame() - 1;
  }

  void declare_loss(Context& context) {
    lost_since_ = context.frame();
    if (sure_frame_ < 0) {
      if (given_path_.empty())
        throw ConfigError({}, "the camera's place in the map is not known: `path` must say from where the map was seen");
      context.log().warning("{}: frame {}: the camera's place in the map is not known; it is searched for", context.node(),
                            frame->index);
    } else {
      context.log().warning(
          "{}: frame {}: lost: for {} frames no particle has explained what the camera sees; the maps are left alone until it is "
          "found",
          context.node(), frame->index, context.frame() - sure_frame_);
    }
    learn_places(context);
  }

  /// Brings the best particle to the front, and looks at its map from the known places. Weights mean nothing until a place is found.
  void learn_places(Context& context) {
    std::vector<std::uint32_t> order(belief->size());
    std::iota(order.begin(), order.end(), 0u);
    std::swap(order.front(), order[belief->best()]);
    belief->gather(order);
    view->prepare({belief->map.front().get()}, context.workers());
    places_.build(poses_that_saw_the_map(context), *view, *belief->map.front(), frame->camera, context.workers());
  }

  /// Of the best particle's own path, up to where it was sure, behind those that were given.
  std::vector<Pose> poses_that_saw_the_map(Context& context) const {
    std::vector<Pose> poses;
    for (const auto& at : given_path_) poses.push_back(at.T_map_camera);
    if (sure_frame_ < 0) return poses;
    auto own = belief->trajectory.front().poses();
    own.resize(own.size() - std::min(own.size(), static_cast<std::size_t>(context.frame() - sure_frame_)));
    for (const auto& at : own) poses.push_back(at.T_map_camera);
    return poses;
  }

  void search(Context& context) {
    const std::int64_t age = context.frame() - lost_since_;
    std::vector<SearchStart> starts;
    if (sure_frame_ >= 0) starts.push_back(search_.around(anchors()[0], age));
    if (sure_frame_ < 0 || age >= search_.local_frames()) add_places(starts, context);
    try_starts(starts, context);
    if (found_.empty())
      spread(age, context);
    else
      start_anew(context);
  }

  /// Tries the known places beside the one that the particles hold, and takes what explains the frame.
  void look_elsewhere(Context& context) {
    learn_places(context);
    std::vector<SearchStart> starts;
    add_places(starts, context);
    try_starts(starts, context);
    const bool here = std::ranges::any_of(found_, [&](const Alignment& at) { return is_near(at.T_map_camera, belief->pose.front()); });
    if (found_.empty() || here) {
      found_.clear();
      places_.forget();
      return;
    }
    context.log().warning("{}: frame {}: lost: for {} frames the view was not explained well, and another place explains it",
                          context.node(), frame->index, watch_.doubt());
    lost_since_ = context.frame();
    sure_frame_ = std::max<std::int64_t>(0, context.frame() - watch_.doubt());
    start_anew(context);
  }

  static bool is_near(const Pose& a, const Pose& b) {
    constexpr double kNear_m = 0.1, kNear_rad = 0.1;
    return are_near(a, b, kNear_m, kNear_rad);
  }

  void add_places(std::vector<SearchStart>& starts, Context& context) const {
    for (const auto& c : places_.candidates(*frame, context.workers())) starts.push_back(search_.at_place(c.T_map_camera));
  }

  void try_starts(const std::vector<SearchStart>& starts, Context& context) {
    const Map& map = *belief->map.front();
    view->prepare({&map}, context.workers());
    aligner_.begin(*frame);
    tried_ = starts.size();
    found_ = search_.run(starts, aligner_, *view, map, context);
  }

  /// All particles become copies of the one whose map was searched, shared out over the places found, by likelihood.
  void start_anew(Context& context) {
    auto& particles = *belief;
    particles.gather(std::vector<std::uint32_t>(particles.size(), 0));
    auto& fits = particles.column<ViewFit>(kViewFitColumn);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Alignment& at = found_[i % found_.size()];
      const bool first = i < found_.size();  // stands at the optimum
      stand(i, first ? at.T_map_camera : draw_around(at, normal_twist(context.rng("place", i))).T_map_camera, context);
      particles.log_weight[i] = at.likelihood;
      const auto points = static_cast<double>(std::max<std::size_t>(at.fit.points, 1));
      fits[i] = {static_cast<float>(at.fit.outlier_share()), static_cast<float>(1 - static_cast<double>(at.fit.seen) / points)};
    }
    particles.normalize();
    watch_.returned();
    context.log().info("{}: frame {}: a place that explains the frame ({} of {} tried); it must hold", context.node(),
                       frame->index, found_.size(), tried_);
  }

  void spread(std::int64_t age, Context& context) {
    auto& particles = *belief;
    std::ranges::fill(particles.log_weight, -std::log(static_cast<double>(particles.size())));
    if (sure_frame_ < 0) return;
    const PoseNoise noise = search_.spread(age);
    for (std::size_t i = 0; i < particles.size(); ++i)
      stand(i, anchors()[i] * noise.draw(context.rng("spread", i)), context);
  }

  /// A proposal that looks found the way by itself: what it came from is no velocity.
  void rest(Context& context) {
    for (std::size_t i = 0; i < belief->size(); ++i) stand(i, belief->pose[i], context);
  }

  /// Puts a particle at a pose, at rest: motion models read velocity and acceleration off the last entries of its path. Entries
  /// from before the loss stay.
  void stand(std::size_t i, const Pose& T_map_camera, Context& context) {
    constexpr std::int64_t kRest = 3;
    auto& path = belief->trajectory[i];
    const auto unsure = std::min<std::int64_t>(context.frame() - sure_frame_, static_cast<std::int64_t>(path.length()));
    std::vector<StampedPose> last;
    for (std::int64_t k = 0; k < std::min(unsure, kRest); ++k) {
      last.push_back(path.last());
      path = path.parent();
    }
    for (auto at = last.rbegin(); at != last.rend(); ++at) {
      at->T_map_camera = T_map_camera;
      path.extend(*at);
    }
    belief->pose[i] = T_map_camera;
  }

  void declare_found(Context& context) {
    context.log().info("{}: frame {}: found, after {} frames", context.node(), frame->index, context.frame() - lost_since_);
    places_.forget();
  }

  void record(Context& context) {
    float explained = 0;
    for (const auto& fit : belief->column<ViewFit>(kViewFitColumn).values)
      explained = std::max(explained, (1 - fit.outliers) * (1 - fit.misses));
    context.metric("lost", watch_.phase() == LossWatch::Phase::tracked ? 0 : 1);
    context.metric("unexplained", watch_.verdict() == LossWatch::Verdict::unexplained ? 1 : 0);
    context.metric("explained", static_cast<double>(explained));
    context.metric("places", static_cast<double>(places_.size()));
    context.metric("tried", static_cast<double>(tried_));
    context.metric("accepted", static_cast<double>(found_.size()));
  }

  LossWatch watch_;
  KnownPlaces places_;
  PlaceSearch search_;
  ViewAligner aligner_;
  std::filesystem::path path_;
  std::vector<StampedPose> given_path_;

  bool said_lost_ = false;         // what belief.lost was left as
  std::int64_t sure_frame_ = -1;   // of this run, the last that was tracked for sure; -1: none yet
  std::int64_t lost_since_ = 0;
  // Of one frame.
  std::size_t tried_ = 0;
  std::vector<Alignment> found_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Relocalize>("recovery.relocalize",
                    "Says when the camera is lost, keeps the maps from harm, and finds it again where the map has been seen.",
                    "Thrun, Burgard, Fox, \"Probabilistic Robotics\", section 8.3.3; Milford, Wyeth, \"SeqSLAM\", ICRA 2012");
}
