#pragma once
#include <cstddef>
#include <vector>

#include "framework/slam/particle_set.hpp"

namespace ppm {

/// For each particle the lowest particle with the same map at the same pose (bit by bit) and, if asked, the same
/// prediction: copies of one ancestor, for which the same work need not be done twice. twins[i] == i for those to do
/// the work.
std::vector<std::size_t> twins(const ParticleSet& belief, bool same_prediction);

/// The same for other poses than the belief's own, one a particle.
std::vector<std::size_t> twins(const ParticleSet& belief, const std::vector<Pose>& poses);

/// For each particle the lowest particle with the same map, wherever they are.
std::vector<std::size_t> map_twins(const ParticleSet& belief);

/// The maps of a belief, each once, in the order of the first particle that has each.
std::vector<const Map*> distinct_maps(const ParticleSet& belief);

}  // namespace ppm
