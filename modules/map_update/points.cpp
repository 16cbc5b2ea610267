#include "framework/graph/registry.hpp"
#include "framework/roles/map_update.hpp"
#include "modules/maps/points/point_update.hpp"

namespace {

using namespace ppm;

/// Writes what a frame says into every particle's points.
/// frame   [rows*cols] depth and its sigma, NaN = no return; lateral_px
/// belief  needs a prediction of this frame's view (any stride: the update then works on the prediction's grid)
/// source  Keller et al., 3DV 2013
class PointUpdate final : public MapUpdate {
 public:
  PointUpdate() : MapUpdate({{"map.points", "prediction.elements"}, {}, {}}) {
    add_association();
    add_points();
    add_votes();
    add_keyframe_params();
  }

  void before(Context& context) override {
    MapUpdate::before(context);
    tallies_.resize(context.threads());
  }

 protected:
  MapHandle learn(Context& context, std::size_t particle, MapHandle map, int worker) override {
    const auto& view = belief->prediction[particle];
    PPM_CHECK(view, "particle {} has no prediction", particle);
    const PredictionHandle whole = completed(view, completed_, context.workers());
    return update_points(std::static_pointer_cast<const PointMap>(std::move(map)), *frame, *whole, settings_, tallies_[worker]);
  }

 private:
  void add_association() {
    params_.add("gate", settings_.gate_sigmas)
        .range(0.1, 100)
        .doc("A measurement within so many standard deviations of a disc, along its normal, is of that disc.");
    params_.add("gate_pose", settings_.gate_pose_m)
        .unit("m")
        .range(0, 1)
        .doc("Standard deviation that the gate adds for the error of the pose and of the map.");
    params_.add("gate_map_most", settings_.map_sigma_most_m)
        .unit("m")
        .range(0, 1)
        .doc("An uncertain point widens the gate by its standard deviation, but not by more than this.");
    params_.add("agree", settings_.agree_cosine)
        .range(-1, 1)
        .doc("Least cosine between the normals of what is one surface.");
    params_.add("sigma_least", settings_.sigma_least_m)
        .unit("m")
        .range(1e-6, 1)
        .doc("No point gets surer than this by its measurements, so that it stays open to change.");
  }
  void add_points() {
    params_.add("cosine_least", settings_.cosine_least)
        .range(0, 1)
        .doc("Surface that faces the camera less than so much (cosine of the angle of incidence) makes no points.");
    params_.add("depth_jump", settings_.jump_m)
        .unit("m")
        .range(0, 10)
        .doc("Pixels where the measured depth departs from a plane through its neighbours by more make no points.");
    params_.add("normal_reach", settings_.normal_reach)
        .range(1, 16)
        .doc("Measured normals are of the plane through the neighbours so many pixels away, or, across an edge, the next ones.");
    params_.add("radius_pixels", settings_.radius_pixels)
        .range(0, 100)
        .doc("A disc's radius is the map's spacing, but at least so many times the distance between pixels on the surface.");
    params_.add("scatter_sigma", settings_.scatter_sigma_m)
        .unit("m")
        .range(0, 1)
        .doc("Standard deviation of measurements about a new point beside the sensor's, before it is known from them.");
    params_.add("scatter_frames", settings_.scatter_frames)
        .range(1, 65535)
        .doc("Number of frames that this counts for.");
  }
  void add_votes() {
    params_.add("votes_ratio", settings_.votes_ratio)
        .range(0, 1000)
        .doc("A point goes when the frames that saw through it outnumber those that hit it by this factor and votes_free.");
    params_.add("votes_free", settings_.votes_free)
        .range(0, 65535)
        .doc("Frames that may see through a point before they count against it.");
    params_.add("votes_cosine", settings_.votes_cosine)
        .range(0, 1)
        .doc("Pixels that meet a disc at a smaller cosine of incidence speak neither for nor against it.");
    params_.add("votes_forget", settings_.votes_forget)
        .range(0, 1)
        .doc(
            "Share of a point's hits that each frame takes away in which it is only seen through: what stood for long and left "
            "goes soon.");
  }

  PointUpdateSettings settings_;
  PerWorker<PointTallies> tallies_;
  PredictionPool completed_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<PointUpdate>("map_update.points",
                     "Fuses a frame into maps of points: discs that are measured move and turn, new surface adds points, and what is "
                     "seen through goes.",
                     "Keller et al., \"Real-time 3D reconstruction in dynamic scenes using point-based fusion\", 3DV 2013");
}
