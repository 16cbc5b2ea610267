#include "framework/roles/view_aligner.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ppm {

namespace {

constexpr std::size_t kLevels = 3;
/// Steps of the levels' grids, in steps of the finest. The first is for many starts, where it has points enough; the others
/// are those of an alignment.
constexpr std::array<int, kLevels + 1> kCoarser{8, 4, 2, 1};
constexpr std::size_t kEnoughPoints = 200;

/// A view's own place and a pose that is compared with it: farther apart the view is drawn again.
constexpr double kNear_m = 0.02, kNear_rad = 0.02;

/// Alignments nearer to each other than this are of one place.
constexpr double kApart_m = 0.03, kApart_rad = 1.5 * std::numbers::pi / 180;

}  // namespace

std::vector<Alignment> distinct_places(std::vector<Alignment> found, std::size_t most) {
  std::ranges::stable_sort(found, std::greater(), &Alignment::likelihood);
  std::vector<Alignment> places;
  for (const auto& at : found) {
    if (places.size() == most) break;
    const auto is_here = [&](const Alignment& place) {
      return are_near(place.T_map_camera, at.T_map_camera, kApart_m, kApart_rad);
    };
    if (std::ranges::none_of(places, is_here)) places.push_back(at);
  }
  return places;
}

PoseDraw draw_around(const Alignment& at, const Twist& z) {
  const Eigen::LLT<Matrix6> root(at.information);
  const double log_density =
      root.matrixLLT().diagonal().array().log().sum() - 0.5 * z.squaredNorm() - 3 * std::log(2 * std::numbers::pi);
  return {at.T_map_camera * se3_exp(root.matrixU().solve(z)), log_density};
}

void ViewAligner::declare(Params& params) {
  params.add("view_stride", stride_).range(1, 64).doc("Draws each n-th pixel of each n-th row of the view to align to.");
  params.add("step", step_fine_)
      .range(1, 64)
      .doc("The finest level compares each n-th pixel of each n-th row of the frame; two coarser ones each 2n-th and 4n-th.");
  params.add("depth_jump", jump_)
      .unit("m")
      .range(0, 10)
      .doc("Pixels where the measured depth departs from a plane through its neighbours by more are left out.");
  params.add("distance", distance_)
      .unit("m")
      .range(0.001, 10)
      .doc("Points farther than this from the surface that they fall onto are not aligned to it.");
  params.add("normal_cosine", normal_cosine_)
      .range(-1, 1)
      .doc("Nor are points whose measured normal is turned away from the surface's by more (cosine).");
  params.add("cauchy", cauchy_)
      .range(0.1, 100)
      .doc("Scale of the robust kernel of the wide manner, standard deviations.");
  params.add("model_sigma", model_sigma_)
      .unit("m")
      .range(0, 1)
      .doc("Standard deviation of the map's surface beside that of its texels.");
  params.add("hold_least", hold_least_)
      .range(0, 1)
      .doc(
          "A direction is held by the view where moving by 1 m (or turning by 1 m at the points' range) changes the "
          "residuals' mean square by more than this, m^2; others are left to the motion prior. 0: all count as they are.");
  params.add("alpha", alpha_)
      .range(0, 1)
      .above(0)
      .doc("Factor on the information of the pixels, which err together (their residuals' correlation says .008 to .1).");
}

void ViewAligner::declare_limits(Params& params) {
  params.add("outliers_most", outliers_most_)
      .range(0, 1)
      .doc(
          "An alignment that leaves a larger share of the seen pixels farther than 3 sigma + 1 cm from the map does not "
          "explain the frame.");
  params.add("outliers_lost", outliers_lost_)
      .range(0, 1)
      .doc("One that leaves a larger share than this is no better than none.");
  params.add("inliers_least", inliers_least_)
      .range(0, 1)
      .doc("Nor is one that explains a smaller share of the measured pixels.");
}

void ViewAligner::begin(const Frame& frame) {
  camera_ = frame.camera;
  std::vector<int> steps;
  for (int coarser : kCoarser) steps.push_back(coarser * step_fine_);
  measured_.build(frame, steps, jump_);
}

void ViewAligner::look(const ViewPredictor& predictor, const Map& map, const Pose& T_map_camera, AlignScratch& scratch,
                       int worker) const {
  scratch.drawn.reset(camera_, stride_, T_map_camera);
  predictor.predict_all(map, scratch.drawn, worker);
  scratch.view.build(scratch.drawn);
}

ViewAligner::Level ViewAligner::level(Manner manner, std::size_t k) const {
  constexpr std::array<int, kLevels> kCloseSteps{6, 5, 5}, kWideSteps{10, 8, 6};
  constexpr std::array<double, kLevels> kCloseWidth{2, 1, 1}, kWideWidth{5, 2.5, 1.2};
  AlignmentGate gate{distance_, normal_cosine_, 0, model_sigma_};
  if (manner == Manner::close) {
    gate.distance_m *= kCloseWidth[k];
    return {kCloseSteps[k], gate};
  }
  gate.distance_m *= kWideWidth[k];
  gate.normal_cosine = k + 1 < kLevels ? 0.5 * normal_cosine_ : normal_cosine_;
  gate.cauchy = cauchy_;
  return {kWideSteps[k], gate};
}

void ViewAligner::descend(const MeasuredSurface::Level& points, const Level& how, const SurfaceView& view, const MotionPrior& prior,
                          Alignment& at) const {
  constexpr double kSmall = 1e-5;  // m and rad: what a further step would not be worth
  const Matrix6 P = prior.information();
  for (int step = 0; step < how.steps; ++step) {
    AlignmentSum sum = align_sum(points, view, at.T_map_camera, how.gate);
    if (hold_least_ > 0) sum.drop_weak_directions(hold_least_);
    at.information = alpha_ * sum.H + P;
    at.likelihood = likelihood(sum);
    const Twist x = at.information.ldlt().solve(alpha_ * sum.b - P * prior.offset(at.T_map_camera));
    if (!x.allFinite()) return;
    at.T_map_camera = at.T_map_camera * se3_exp(x);
    if (x.norm() < kSmall) return;
  }
}

double ViewAligner::likelihood(const AlignmentSum& sum) const {
  // A seen point that is no inlier counts as one three standard deviations away; one that falls beside the map a little less.
  const auto outliers = static_cast<double>(sum.seen - sum.inliers), unseen = static_cast<double>(sum.points - sum.seen);
  return -0.5 * alpha_ * (sum.cost + 9.0 * outliers + 6.0 * unseen);
}

Alignment ViewAligner::align(const ViewPredictor& predictor, const Map& map, const MotionPrior& prior, const Pose& start,
                             Manner manner, AlignScratch& scratch, int worker) const {
  Alignment at;
  at.T_map_camera = start;
  look(predictor, map, start, scratch, worker);
  for (std::size_t k = 0; k < kLevels; ++k) {
    const auto& points = measured_.levels[k + 1];
    descend(points, level(manner, k), scratch.view, prior, at);
    const bool again = manner == Manner::wide || k + 1 == kLevels;
    if (again && !are_near(scratch.view.T_map_camera, at.T_map_camera, kNear_m, kNear_rad)) {
      look(predictor, map, at.T_map_camera, scratch, worker);
      if (k + 1 == kLevels) descend(points, level(Manner::close, k), scratch.view, prior, at);
    }
  }
  at.fit = alignment_fit(measured_.levels.back(), scratch.view, at.T_map_camera);
  return at;
}

Alignment ViewAligner::align_coarsely(const SurfaceView& view, const MotionPrior& prior, const Pose& start) const {
  Alignment at;
  at.T_map_camera = start;
  const auto& points = measured_.levels[measured_.levels.front().size() < kEnoughPoints ? 1 : 0];
  descend(points, level(Manner::wide, 0), view, prior, at);
  at.fit = alignment_fit(points, view, at.T_map_camera);
  at.likelihood = likelihood(align_sum(points, view, at.T_map_camera, level(Manner::wide, 1).gate));
  return at;
}

}  // namespace ppm
