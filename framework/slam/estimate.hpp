#pragma once
#include <string>
#include <utility>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// One pose for a belief.
enum class Estimate {
  best,  ///< of the particle with the largest weight
  mean,  ///< weighted mean
  mode,  ///< where the particles are densest
};
/// The names in graphs.
const std::vector<std::pair<std::string, Estimate>>& estimate_names();
std::string to_string(Estimate estimate);

/// How far particles lie from their mean.
struct Spread {
  double translation_m = 0;  ///< root of the trace of the positions' covariance
  double rotation_rad = 0;   ///< root of the trace of the covariance of the rotations' logarithms about the mean
};

/// Weighted means of the positions and, chordal, of the rotations. Source: Hartley, Trumpf, Dai, Li, "Rotation averaging",
/// IJCV 2013, section 5.3.
Pose mean_pose(const ParticleSet& belief);
Spread spread(const ParticleSet& belief);
/// The top of a Gaussian kernel density of the poses, in the tangent space of their mean, climbed from the densest particle.
/// Kernel widths follow the particles' spread (Silverman's rule of thumb), one for positions and one for rotations. Where
/// particles are in several places, it is one of them, not the nowhere between. Work grows with the square of the number of
/// particles. Source: Comaniciu, Meer, "Mean shift", PAMI 2002.
Pose mode_pose(const ParticleSet& belief);
/// T_map_camera. belief: not empty, weights normalised.
Pose estimate_pose(const ParticleSet& belief, Estimate estimate);

}  // namespace ppm
