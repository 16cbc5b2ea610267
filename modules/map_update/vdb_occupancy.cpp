#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/map_update.hpp"
#include "modules/maps/vdb/occupancy_update.hpp"

namespace {

using namespace ppm;

/// Writes a frame into every particle's occupancy grid.
/// frame   [rows*cols] depth and its sigma, NaN = no return
/// belief  pose and map; needs no prediction
/// source  see update_occupancy()
class VdbOccupancyUpdate final : public MapUpdate {
 public:
  VdbOccupancyUpdate() : MapUpdate({{"map.vdb"}, {}, {}}) {
    params_
        .add_choice("model", settings_.form,
                    {{"profile", OccupancyForm::profile}, {"literal", OccupancyForm::literal}})
        .doc(
            "What a measurement says of the voxels along its ray: profile is a ramp of log-odds from free to occupied "
            "through the measured range, as wide as the sensor is unsure, read by each voxel in view; literal is a hit "
            "for the voxel that the ray ends in and a miss for those that it passes, as OctoMap has it.");
    params_.add("hit", hit_).range(0.501, 0.999).doc("Probability of being occupied that one measurement gives at most.");
    params_.add("miss", miss_).range(0.001, 0.499).doc("The same for free space: the least.");
    params_.add("width_sigmas", settings_.width_sigmas)
        .range(0, 100)
        .doc("Half width of the profile's ramp in standard deviations of the measured range ...");
    params_.add("width_voxels", settings_.width_voxels)
        .range(0.1, 100)
        .doc("... and in voxels, at least: so that neighbours around a surface tell where between them it lies.");
    params_.add("thickness_voxels", settings_.thickness_voxels)
        .range(0.1, 100)
        .doc("What lies so many voxels behind the measured range, and behind the ramp, stays as it is.");
    params_.add("memory", settings_.memory)
        .range(0, 1e9)
        .doc(
            "Frames in which the log-odds of a voxel in view fade to 1/e: the bound on evidence that keeps the ratio "
            "between neighbours, so that new surfaces can replace old ones. 0 = never, clamps alone bound it.");
    params_.add("max_range", settings_.max_range_m)
        .unit("m")
        .range(0.01, 1e6)
        .doc("Measurements beyond it say that there is free space so far, and nothing more.");
    add_keyframe_params();
  }

  void before(Context& context) override {
    MapUpdate::before(context);
    settings_.log_odds_hit = log_odds(hit_);
    settings_.log_odds_miss = log_odds(miss_);
    view_.build(*frame, static_cast<const VdbMap&>(*belief->map[0]), settings_);
  }

 protected:
  MapHandle learn(Context& context, std::size_t particle, MapHandle map, int) override {
    return update_occupancy(std::static_pointer_cast<const VdbMap>(std::move(map)), view_, belief->pose[particle],
                            context.workers());
  }

 private:
  static float log_odds(double probability) { return static_cast<float>(std::log(probability / (1 - probability))); }

  double hit_ = 0.7, miss_ = 0.4;
  OccupancySettings settings_;
  OccupancyView view_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<VdbOccupancyUpdate>(
      "map_update.vdb_occupancy",
      "Writes a frame into the occupancy grid: free up to the measured surface, occupied behind it, once a voxel.",
      "Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 9; Funk et al., \"Multi-Resolution 3D Mapping With "
      "Explicit Free Space Representation\", IEEE Robotics and Automation Letters, 2021; Hornung et al., \"OctoMap\", "
      "Autonomous Robots, 2013");
}
