#include "framework/core/only_handle.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/map_update.hpp"
#include "modules/maps/octomap/octomap_map.hpp"

namespace {

using namespace ppm;

/// Writes a frame into every particle's octree: each cell that a ray ends in is hit, each that rays only go through is
/// missed, once a frame.
/// frame   [rows*cols] depth, NaN = no return: says nothing
/// source  Hornung et al. 2013, section 3; OcTree::insertPointCloud with its defaults
class OctomapUpdate final : public MapUpdate {
 public:
  OctomapUpdate() : MapUpdate({{"map.octomap"}, {}, {}}) {
    auto& sensor = how_.sensor;
    params_.add("hit", sensor.hit).range(0.5, 0.999).doc("Probability that a cell is occupied where a ray ends in it.");
    params_.add("miss", sensor.miss).range(0.001, 0.5).doc("Probability that a cell is occupied where rays go through it.");
    params_.add("clamp_least", sensor.clamp_least).range(0.001, 0.5).doc("No cell becomes less probably occupied.");
    params_.add("clamp_most", sensor.clamp_most).range(0.5, 0.999).doc("No cell becomes more probably occupied.");
    params_.add("range_most", how_.range_most_m)
        .unit("m")
        .range(0, 1000)
        .doc("Longer rays are cut there and leave no hit. 0 = none are.");
    params_.add("discretize", how_.discretize)
        .doc("Casts one ray to the centre of each cell that points fall into, in place of one to each point.");
    params_.add("stride", how_.stride).range(1, 64).doc("Inserts each n-th pixel of each n-th row.");
    add_keyframe_params();
  }

 protected:
  MapHandle learn(Context&, std::size_t particle, MapHandle map, int) override {
    auto tree = writable(std::move(map));
    tree->insert(*frame, belief->pose[particle], how_);
    return tree;
  }

 private:
  /// The map itself where nobody else has it, else a copy.
  static std::shared_ptr<OctomapMap> writable(MapHandle map) {
    auto tree = std::static_pointer_cast<const OctomapMap>(std::move(map));
    if (!is_only_handle(tree)) return std::make_shared<OctomapMap>(*tree);
    return std::const_pointer_cast<OctomapMap>(std::move(tree));
  }

  OctomapInsertion how_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<OctomapUpdate>("map_update.octomap", "Writes a frame into the octree by OctoMap's inverse sensor model.",
                       "Hornung et al. 2013");
}
