#include "framework/slam/map_memory.hpp"

#include <unordered_set>

namespace ppm {

MapMemory map_memory(const ParticleSet& belief) {
  MapMemory memory;
  std::unordered_set<const void*> seen;
  for (const auto& map : belief.map) {
    if (!map) continue;
    memory.together += map->account(seen);
    memory.alone += map->stats().bytes;
  }
  return memory;
}

}  // namespace ppm
