#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/config/params.hpp"
#include "framework/roles/view_predictor.hpp"
#include "framework/slam/view_alignment.hpp"

namespace ppm {

/// A pose at which the map explains the frame best, near where the search began.
struct Alignment {
  Pose T_map_camera = Pose::Identity();
  Matrix6 information = Matrix6::Zero();  ///< of the pose's twist (right), tempered, with the prior's
  AlignmentFit fit;                       ///< beside a view at (nearly) this pose
  double likelihood = 0;                  ///< tempered log likelihood of the residuals, to compare alignments of a frame
};

/// The places among some alignments: the likeliest of each, likeliest first, at most so many. Within 3 cm and 1.5 degrees is
/// one place.
std::vector<Alignment> distinct_places(std::vector<Alignment> found, std::size_t most = std::numeric_limits<std::size_t>::max());

/// A pose from the Gaussian around an alignment's optimum, and the log density of its twist there.
struct PoseDraw {
  Pose T_map_camera = Pose::Identity();
  double log_density = 0;
};
/// z: standard normal; zero for the optimum itself.
PoseDraw draw_around(const Alignment& at, const Twist& z);

/// Memory of one worker.
struct AlignScratch {
  Prediction drawn;
  SurfaceView view;
};

/// Lays a frame onto a particle's own predicted view, coarse to fine: Gauss-Newton on point-to-plane residuals with the
/// motion prior, tempered because neighbouring pixels err together:
///   (alpha H + P) x = alpha b - P xi,   xi = log(T_prior^-1 T),   T <- T exp(x)
/// Two manners: `close` for small steps (tight gates, least squares, one view), `wide` for large ones (wide gates, a Cauchy
/// kernel, more steps on the coarse levels, views drawn again on the way).
/// Source: Grisetti, Stachniss, Burgard, "Improved techniques for grid mapping with Rao-Blackwellized particle filters",
/// T-RO 2007 (scan matching before the draw); Rusinkiewicz, Levoy, 3DIM 2001.
class ViewAligner {
 public:
  enum class Manner { close, wide };

  /// How frames are aligned.
  void declare(Params& params);
  /// What explains() and usable() ask for.
  void declare_limits(Params& params);
  /// Once a frame: the points of the frame, shared by all alignments.
  void begin(const Frame& frame);
  /// Draws what the map shows from a pose into scratch.view.
  void look(const ViewPredictor& predictor, const Map& map, const Pose& T_map_camera, AlignScratch& scratch,
            int worker) const;
  /// From a start to the optimum: looks from the start first, and again where the pose has moved far. Called from any worker.
  Alignment align(const ViewPredictor& predictor, const Map& map, const MotionPrior& prior, const Pose& start,
                  Manner manner, AlignScratch& scratch, int worker) const;
  /// The coarse levels alone, on a view that is there, for many starts: pose, fit and likelihood on the coarsest level.
  Alignment align_coarsely(const SurfaceView& view, const MotionPrior& prior, const Pose& start) const;
  /// Whether a fit is one of a frame at its place: few outliers, and inliers enough.
  bool explains(const AlignmentFit& fit) const {
    return fit.outlier_share() <= outliers_most_ && fit.inlier_share() >= inliers_least_;
  }
  /// Whether it is still better than no alignment: things may have moved.
  bool usable(const AlignmentFit& fit) const {
    return fit.outlier_share() <= outliers_lost_ && fit.inlier_share() >= inliers_least_;
  }
  const MeasuredSurface& measured() const { return measured_; }

 private:
  /// Levels' gates and numbers of steps of a manner.
  struct Level {
    int steps;
    AlignmentGate gate;
  };
  Level level(Manner manner, std::size_t k) const;
  /// `steps` Gauss-Newton steps on a level; fewer where they have become small.
  void descend(const MeasuredSurface::Level& points, const Level& how, const SurfaceView& view, const MotionPrior& prior, Alignment& at) const;
  double likelihood(const AlignmentSum& sum) const;

  int stride_ = 2;
  int step_fine_ = 2;
  double jump_ = 0.05, distance_ = 0.06, normal_cosine_ = 0.85, cauchy_ = 2, model_sigma_ = 0.001, alpha_ = 0.1, hold_least_ = 0.0015;
  double outliers_most_ = 0.10, outliers_lost_ = 0.4, inliers_least_ = 0.15;
  Camera camera_;
  MeasuredSurface measured_;
};

}  // namespace ppm
