#include "framework/graph/registry.hpp"
#include "framework/roles/empty_map.hpp"
#include "modules/maps/octomap/octomap_codec.hpp"
#include "modules/maps/octomap/octomap_map.hpp"

namespace {

using namespace ppm;

/// Starts with an empty octree.
class OctomapEmpty final : public EmptyMap {
 public:
  OctomapEmpty() : EmptyMap("map.octomap") {
    params_.add("voxel_size", voxel_size_m_).unit("m").above(0).doc("Edge of the smallest cells.");
    params_.add("occupied", occupied_)
        .range(0.01, 0.99)
        .doc("Probability from which a cell counts as occupied.");
  }

 protected:
  MapHandle make(const Frame&) const override { return std::make_shared<OctomapMap>(voxel_size_m_, occupied_); }

 private:
  double voxel_size_m_ = 0.05;
  double occupied_ = 0.5;
};

}  // namespace

PPM_MODULES(r) {
  r.add_map_kind<OctomapCodec>("octomap");
  r.add<OctomapEmpty>("map.octomap", "Starts the belief: particles at one pose that share one empty OctoMap.",
                      "Hornung et al. 2013");
}
