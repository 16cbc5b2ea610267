#pragma once
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// What benchmarks look at: a map of the meshed room, and noisy images of it from some places.
struct BenchWorld {
  std::shared_ptr<const PpmMap> map;
  std::vector<std::shared_ptr<const Frame>> frames;  ///< a cycle; reference poses in the map's frame
  std::vector<std::shared_ptr<const PpmMap>> own;    ///< maps of the same room that share no chunk
  const std::vector<std::shared_ptr<const PpmMap>>& own_maps(std::size_t n);  ///< makes what is missing of n
};

/// Worlds by size, made when they are asked for and kept.
class BenchWorlds {
 public:
  /// registry: must outlive the object; images are rendered by its prediction.embree. texel_size_m: of the maps.
  BenchWorlds(const Registry& registry, double texel_size_m) : registry_(registry), texel_size_m_(texel_size_m) {}
  /// triangles: of the map, about. cols: of the camera, 9 rows for 11 columns, with the same field of view at any size.
  BenchWorld& of(int triangles, int cols);

 private:
  const Registry& registry_;
  double texel_size_m_;
  std::map<std::pair<int, int>, BenchWorld> worlds_;
};

}  // namespace ppm
