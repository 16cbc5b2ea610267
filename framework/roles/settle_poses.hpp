#pragma once
#include <functional>
#include <vector>

#include "framework/graph/context.hpp"
#include "framework/roles/view_aligner.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// How a new pose is taken from the Gaussian around an alignment's optimum.
enum class Draw { sample, optimum };

/// The end of a proposal that looks at the image first: each particle's pose is taken around its alignment, and its weight takes
/// the density of the motion prior over that of the draw. A particle without one (null) keeps the pose that its motion
/// model drew; where others have one, it weighs no more than the least of those. Sets the column kMotionSeenColumn.
/// Draws context.rng("draw", particle).
/// log_prior: log density of a pose of a particle as its motion is known. Called from any worker.
/// Source: Montemerlo et al., "FastSLAM 2.0", IJCAI 2003.
void settle_poses(ParticleSet& particles, const std::vector<const Alignment*>& at, Draw draw,
                  const std::function<double(std::size_t particle, const Pose& T_map_camera)>& log_prior, Context& context);

}  // namespace ppm
