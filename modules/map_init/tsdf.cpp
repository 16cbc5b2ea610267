#include "framework/graph/registry.hpp"
#include "framework/roles/empty_map.hpp"
#include "modules/maps/tsdf/tsdf_codec.hpp"
#include "modules/maps/tsdf/tsdf_map.hpp"

namespace {

using namespace ppm;

/// Starts with an empty volume.
class TsdfEmpty final : public EmptyMap {
 public:
  TsdfEmpty() : EmptyMap("map.tsdf") {
    params_.add("voxel_size", settings_.voxel_size_m).unit("m").above(0).doc("Edge of the voxels.");
    params_.add("truncation", settings_.truncation_m)
        .unit("m")
        .above(0)
        .doc("Signed distances are cut there: a surface thinner than this is seen from one side only.")
        .check([this] {
          return settings_.truncation_m >= 2 * settings_.voxel_size_m ? "" : "must be at least two voxels";
        });
  }

 protected:
  MapHandle make(const Frame&) const override { return std::make_shared<TsdfMap>(settings_); }

 private:
  TsdfSettings settings_;
};

}  // namespace

PPM_MODULES(r) {
  r.add_map_kind<TsdfCodec>("tsdf");
  r.add<TsdfEmpty>("map.tsdf",
                   "Starts the belief: particles at one pose that share one empty volume of signed distances.",
                   "Curless and Levoy 1996; Zhou, Park, Koltun 2018");
}
