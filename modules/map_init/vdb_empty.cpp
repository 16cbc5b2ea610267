#include "framework/graph/registry.hpp"
#include "framework/roles/empty_map.hpp"
#include "modules/maps/vdb/vdb_codec.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {
namespace {

/// Starts with an occupancy grid in which nothing is known.
class VdbEmpty final : public EmptyMap {
 public:
  VdbEmpty() : EmptyMap("map.vdb") {
    params_.add("voxel_size", settings_.voxel_size_m).unit("m").above(0).doc("Edge of a voxel.");
    params_.add("log_odds_min", settings_.log_odds_min)
        .range(-100, -0.01)
        .doc(
            "Least log-odds of being occupied that a voxel takes. What is clamped to it over a whole leaf of 8^3 voxels "
            "takes no memory.");
    params_.add("log_odds_max", settings_.log_odds_max)
        .range(0.01, 100)
        .doc("Greatest log-odds of being occupied that a voxel takes.");
  }

 protected:
  MapHandle make(const Frame&) const override { return std::make_shared<const VdbMap>(settings_); }

 private:
  VdbSettings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add_map_kind<ppm::VdbCodec>("vdb");
  r.add<ppm::VdbEmpty>("map.vdb_empty",
                       "Starts the belief: particles at one pose that share one empty occupancy grid in OpenVDB nodes.",
                       "Museth, \"VDB: High-Resolution Sparse Volumes with Dynamic Topology\", ACM Transactions on "
                       "Graphics, 2013");
}
