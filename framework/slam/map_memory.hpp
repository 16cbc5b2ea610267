#pragma once
#include <cstdint>

#include "framework/slam/particle_set.hpp"

namespace ppm {

/// What the maps of a belief occupy, bytes.
struct MapMemory {
  std::int64_t together = 0;  ///< shared blocks counted once
  std::int64_t alone = 0;     ///< as if every particle had a copy of its own
};
MapMemory map_memory(const ParticleSet& belief);

}  // namespace ppm
