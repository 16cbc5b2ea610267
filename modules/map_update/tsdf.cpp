#include "framework/core/only_handle.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/map_update.hpp"
#include "modules/maps/tsdf/tsdf_map.hpp"

namespace {

using namespace ppm;

/// Averages a frame into every particle's signed distances, each image with the same weight: Open3D's
/// ScalableTSDFVolume::Integrate.
/// frame   [rows*cols] depth, NaN = no return: says nothing
/// source  Curless and Levoy 1996
class TsdfUpdate final : public MapUpdate {
 public:
  TsdfUpdate() : MapUpdate({{"map.tsdf"}, {}, {}}) {
    params_.add("range_most", range_most_m_)
        .unit("m")
        .range(0, 1000)
        .doc("Depths beyond this are not used. 0 = all are.");
    add_keyframe_params();
  }

 protected:
  MapHandle learn(Context&, std::size_t particle, MapHandle map, int) override {
    auto volume = writable(std::move(map));
    volume->integrate(*frame, belief->pose[particle], range_most_m_);
    return volume;
  }

 private:
  /// The map itself where nobody else has it, else a copy that shares its blocks.
  static std::shared_ptr<TsdfMap> writable(MapHandle map) {
    auto volume = std::static_pointer_cast<const TsdfMap>(std::move(map));
    if (!is_only_handle(volume)) return std::make_shared<TsdfMap>(*volume);
    return std::const_pointer_cast<TsdfMap>(std::move(volume));
  }

  double range_most_m_ = 0;
};

}  // namespace

PPM_MODULES(r) {
  r.add<TsdfUpdate>("map_update.tsdf", "Averages a frame's signed distances into the volume.", "Curless and Levoy 1996");
}
