#pragma once
#include <cstddef>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/mesh.hpp"
#include "framework/slam/true_surface.hpp"

namespace ppm {

/// Distances from points of one surface to another surface. NaN and shares of 0 where there is no point, infinite where
/// there is no other surface.
struct SurfaceDistances {
  std::size_t points = 0;
  double median_mm = 0, mean_mm = 0;
  double within_1cm = 0, within_2cm = 0, within_5cm = 0;  ///< shares of the points
};

/// How well the surface of a map is the true one.
/// Source: Seitz et al., CVPR 2006 (accuracy, completeness); Knapitsch et al., ACM ToG 36(4), 2017 (precision, recall, F-score).
struct SurfaceScore {
  SurfaceDistances accuracy;      ///< from the map's surface to the true one
  SurfaceDistances completeness;  ///< from the true surface, as far as it was seen, to the map's
  double precision() const { return accuracy.within_2cm; }
  double recall() const { return completeness.within_2cm; }
  /// Their harmonic mean; 0 where both are 0.
  double f_score() const;
};

constexpr std::size_t kSurfaceSamples = 100000;

/// Points of a mesh, the same number an area everywhere, drawn with a fixed seed; of a mesh without faces its vertices,
/// evenly, at most so many.
std::vector<Eigen::Vector3f> sample_surface(const Mesh& mesh, std::size_t count);

/// mesh: the surface that the map describes, map frame; one without faces counts as its vertices. seen: points of the
/// true surface that the map should have, world frame; where there are more than kSurfaceSamples, so many of them count, evenly.
/// The same numbers for any number of workers.
SurfaceScore score_surface(const Mesh& mesh, const Pose& T_world_map, const TrueSurface& truth,
                           const std::vector<Eigen::Vector3f>& seen, const Workers& workers);

}  // namespace ppm
