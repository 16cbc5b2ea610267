#pragma once
#include <cstddef>

#include "framework/slam/measured_surface.hpp"
#include "framework/slam/motion_prior.hpp"
#include "framework/slam/surface_view.hpp"

namespace ppm {

/// How measured points are laid onto a predicted surface.
/// Source: Rusinkiewicz, Levoy, "Efficient variants of the ICP algorithm", 3DIM 2001 (projective association, point to
/// plane); Newcombe et al., "KinectFusion", ISMAR 2011.
struct AlignmentGate {
  double distance_m = 0.06;   ///< points farther from the surface's tangent plane are of something else
  double normal_cosine = 0.85;  ///< and those whose measured normal is turned further away
  double cauchy = 0;          ///< scale of the robust kernel, standard deviations; 0: least squares
  double model_sigma_m = 0.001;  ///< standard deviation of the map's surface beside that of its texels
};

/// The sum over associated points of what point-to-plane residuals say of a twist xi (right: T exp(xi)).
struct AlignmentSum {
  Matrix6 H = Matrix6::Zero();  ///< sum w J J^T, 1/m^2, 1/m, 1
  Twist b = Twist::Zero();      ///< - sum w J r
  double cost = 0;              ///< sum of w r^2 (of the kernel's weights)
  double weight = 0;            ///< sum of w, 1/m^2
  double squared_range = 0;     ///< sum of w |p|^2: how far the points are from the camera
  std::size_t points = 0;       ///< of the level
  std::size_t seen = 0;         ///< that fall onto a surface of the view
  std::size_t inliers = 0;      ///< within the gate

  /// Takes out of H and b what they say of directions that the surface does not hold: where the weighted mean square of a
  /// residual's change, per unit of the twist (rotations at the points' range), is below `least`, it is but the noise of the
  /// normals, and pulls towards no motion. From there to twice that a part of it is kept.
  /// Source: Zhang, Kaess, Singh, "On degeneracy of optimization-based state estimation problems", ICRA 2016.
  void drop_weak_directions(double least);
};

/// Compares a level's points at the pose T_map_camera with a view. r = n . (q - v): q the point, v and n the surface where
/// it is seen; weight 1 / ((sigma n_z)^2 + model^2 + variance) with n_z the normal's part along the optical axis.
AlignmentSum align_sum(const MeasuredSurface::Level& level, const SurfaceView& view, const Pose& T_map_camera,
                       const AlignmentGate& gate);

/// How a pose explains the measured points, pixel by pixel along the optical axis, beside a view at (nearly) that pose.
struct AlignmentFit {
  std::size_t points = 0;    ///< of the level
  std::size_t seen = 0;      ///< that fall onto a surface of the view
  std::size_t outliers = 0;  ///< of those, farther than 3 sigma + 1 cm from it along the optical axis
  /// Share of the seen points that are outliers; 1 where none is seen.
  double outlier_share() const { return seen > 0 ? static_cast<double>(outliers) / static_cast<double>(seen) : 1.0; }
  /// Share of all points that the surface explains.
  double inlier_share() const {
    return points > 0 ? static_cast<double>(seen - outliers) / static_cast<double>(points) : 0.0;
  }
};
AlignmentFit alignment_fit(const MeasuredSurface::Level& level, const SurfaceView& view, const Pose& T_map_camera);

}  // namespace ppm
