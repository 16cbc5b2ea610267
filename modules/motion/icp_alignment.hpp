#pragma once
#include <vector>

#include "framework/config/params.hpp"
#include "framework/roles/view_aligner.hpp"
#include "framework/slam/measured_surface.hpp"
#include "modules/maps/points/point_index.hpp"

namespace ppm {

/// Lays a frame onto a map of points by iterating closest points, coarse to fine: each measured point is paired with the
/// nearest point of the map whose normal agrees, the pairs that fit worst are left out, and a Gauss-Newton step is made on
/// the rest with the motion prior, tempered because neighbouring pixels err together:
///   (alpha H + P) x = alpha b - P xi,   xi = log(T_prior^-1 T),   T <- T exp(x)
/// Source: Besl, McKay, "A method for registration of 3-D shapes", PAMI 1992 (point to point); Chen, Medioni, "Object
/// modelling by registration of multiple range images", IVC 1992 (point to plane); Rusinkiewicz, Levoy, 3DIM 2001; Chetverikov
/// et al., "The trimmed iterative closest point algorithm", ICPR 2002.
class IcpAlignment {
 public:
  enum class Error { plane, point };
  /// A measured point and its partner in the map.
  struct Pair {
    std::uint32_t measured;
    const SurfacePoint* map;
    float residual_square;  ///< over its variance
  };
  /// Memory of one worker.
  struct Scratch {
    std::vector<Pair> pairs;
    std::vector<float> squares;
  };

  void declare(Params& params);
  /// Once a frame: the points of the frame, shared by all alignments.
  void begin(const Frame& frame);
  /// From a start to the optimum. Called from any worker.
  Alignment align(const PointFinder& map, const MotionPrior& prior, const Pose& start, Scratch& scratch) const;

 private:
  void pair(const MeasuredSurface::Level& points, const PointFinder& map, const Pose& T_map_camera, double distance,
            Scratch& scratch) const;
  void trim(Scratch& scratch) const;
  AlignmentSum sum(const MeasuredSurface::Level& points, const Pose& T_map_camera, const Scratch& scratch) const;
  AlignmentFit fit(const MeasuredSurface::Level& points, const PointFinder& map, const Pose& T_map_camera) const;

  Error error_ = Error::plane;
  int step_fine_ = 2, iterations_ = 10;
  double jump_ = 0.05, distance_ = 0.06, normal_cosine_ = 0.85, trim_ = 0, model_sigma_ = 0.001, alpha_ = 0.1, hold_least_ = 0.0015;
  MeasuredSurface measured_;
};

}  // namespace ppm
