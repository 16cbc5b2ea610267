#pragma once
#include <string>

#include "framework/core/parallel.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// XXH3 (128 bit, 32 hexadecimal digits) over poses, log weights, paths and maps in the order of the particles: the
/// same bytes for the same belief, however many threads made it. A map that particles share is hashed once and counts
/// for each.
std::string belief_digest(const ParticleSet& belief, const Workers& workers);

}  // namespace ppm
