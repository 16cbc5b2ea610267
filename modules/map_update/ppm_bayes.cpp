#include <cstdint>
#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/map_update.hpp"
#include "modules/maps/ppm/ppm_update.hpp"

namespace {

using namespace ppm;

/// Writes what a frame says into every particle's mesh.
/// frame   [rows*cols] depth and its sigma, NaN = no return; lateral_px; color where the map has it (DataError where
///         the frame has none)
/// belief  needs a prediction of this frame's view (any stride: the update then works on the prediction's grid)
/// In the frames between keyframes texels take offsets at most, see update_visible_texels().
/// source  paper, section 4.3
class PpmBayesUpdate final : public MapUpdate {
 public:
  PpmBayesUpdate() : MapUpdate({{"map.ppm", "prediction.elements"}, {}, {}}) {
    add_association();
    add_texels();
    add_surface();
    add_holes();
    add_votes();
    add_excess();
    add_color();
    add_keyframe_params();
    add_between();
  }

  void before(Context& context) override {
    MapUpdate::before(context);
    settings_.share();
    seen_.resize(context.threads());
    scratch_.resize(context.threads());
  }

 protected:
  MapHandle learn(Context& context, std::size_t particle, MapHandle map, int worker) override {
    const PredictionHandle whole = completed(view_of(particle), completed_, context.workers());
    return update_map(mesh_of(std::move(map)), *frame, *whole, settings_, keyframe(), context.workers(),
                      scratch_[worker]);
  }

  /// Leaves the faces in view in `seen_`.
  double miss_share(const Map& map, std::size_t particle, int worker) override {
    auto& seen = seen_[worker];
    seen.collect(static_cast<const PpmMap&>(map), *view_of(particle), *frame);
    return seen.miss_share();
  }

  MapHandle between(Context&, std::size_t particle, MapHandle map, int worker) override {
    if (between_ == Between::nothing) return map;
    const auto view = view_of(particle);
    return update_visible_texels(mesh_of(std::move(map)), *frame, view->stride, view->T_map_camera, seen_[worker],
                                 settings_.texels);
  }

 private:
  enum class Between { texels, nothing };

  PredictionHandle view_of(std::size_t particle) const {
    const auto& view = belief->prediction[particle];
    PPM_CHECK(view, "particle {} has no prediction", particle);
    return view;
  }
  static std::shared_ptr<const PpmMap> mesh_of(MapHandle map) {
    return std::static_pointer_cast<const PpmMap>(std::move(map));
  }

  void add_association() {
    params_.add("gate_classify", settings_.classify_sigmas)
        .range(0.1, 100)
        .doc("A measurement within so many standard deviations of a predicted surface is of that surface.");
    params_.add("gate_pose", settings_.gate.pose_sigma)
        .unit("m")
        .range(0, 1)
        .doc("Standard deviation that every gate adds for the error of the pose and of the map.");
    params_.add("gate_map_most", settings_.gate.map_sigma_most)
        .unit("m")
        .range(0, 1)
        .doc("An uncertain texel widens a gate by its standard deviation, but not by more than this.");
    params_.add("gate_cosine_least", settings_.gate.least_cosine)
        .range(0.01, 1)
        .doc("At grazing angles gates stay as wide as at this cosine.");
  }
  void add_texels() {
    params_
        .add_choice("update", settings_.texels.form, {{"gather", TexelForm::gather}, {"scatter", TexelForm::scatter}})
        .doc(
            "How measurements reach texels: scatter lets each pixel update the texel that its ray hit (the paper's "
            "form), gather "
            "lets each visible texel read the image where it is seen.");
    params_
        .add_choice("new_texels", settings_.texels.new_texels,
                    {{"measured", NewTexels::measured}, {"sensor", NewTexels::sensor}})
        .doc(
            "What the texels of new faces start with: measured fuses the map's prior with what this image measures, "
            "sensor "
            "is zero mean with the sensor's variance (the paper's form).");
    params_.add("texel_pixels", settings_.texels.least_pixels)
        .range(0, 1000)
        .doc(
            "Texels of new faces are no finer than so many pixels are wide where the face is seen: a view from afar "
            "makes coarse texels. 0 = the map's texel_size alone.");
    params_.add("gate_update", settings_.texels.gate_sigmas)
        .range(0.1, 100)
        .doc("A measurement farther than so many standard deviations from a texel's surface does not update it.");
  }
  void add_surface() {
    auto& s = settings_.surface;
    params_.add("open_radius", settings_.open_radius)
        .range(0, 20)
        .doc("New surface is not started in regions thinner than 2 r + 1 pixels, except every thin_every-th frame.");
    params_.add("thin_every", settings_.thin_every)
        .range(0, 1000000)
        .doc("Frames between those in which thin regions are meshed too; 0 = never.");
    params_.add("grazing_every", settings_.grazing_every)
        .range(0, 1000000)
        .doc("Frames between those in which surface may be made down to grazing_cosine; 0 = never.");
    params_.add("grazing_cosine", settings_.grazing_cosine)
        .range(0, 1)
        .doc("The cosine_least of those frames: surface that no view has shown less steeply.");
    params_.add("leaf_min", s.leaves.leaf_min)
        .range(1, 64)
        .doc("Smallest leaf of the quadtree, pixels; a power of two.")
        .check([&s] { return is_power_of_two(s.leaves.leaf_min) ? "" : "must be a power of two"; });
    params_.add("leaf_max", s.leaves.leaf_max)
        .range(1, 64)
        .doc("Largest leaf of the quadtree, pixels; a power of two; leaf_min where that is larger.")
        .check([&s] { return is_power_of_two(s.leaves.leaf_max) ? "" : "must be a power of two"; });
    params_.add("leaf_rms", s.leaves.rms_sigmas)
        .range(0.1, 100)
        .doc(
            "A leaf is flat when its residuals in disparity have a root mean square below so many standard "
            "deviations.");
    params_.add("leaf_valid", s.leaves.valid_share)
        .range(0.1, 1)
        .doc("Least share of a leaf's pixels that must be measured.");
    params_.add("gap_vertex", s.gap_vertex_px)
        .range(0, 100)
        .doc("Corners of leaves that are nearer than so many pixels to a boundary vertex of the map are dropped ...");
    params_.add("gap_vertex_leaf", s.gap_vertex_leaf)
        .range(0, 10)
        .doc("... and those nearer than so many sizes of their leaf.");
    params_.add("gap_edge", s.gap_edge_px)
        .range(0, 100)
        .doc("Corners of leaves that are nearer than so many pixels to a boundary edge of the map are dropped.");
    params_.add("smooth_radius", s.smooth_radius)
        .range(0, 8)
        .doc("Radius in pixels of the smoothing of disparity before leaves are fitted; 0 = none.");
    params_.add("fit_share", s.triangle.fit_share)
        .range(0, 1)
        .doc("Least share of a new triangle's samples where the measurement lies on it.");
    params_.add("own_share", s.triangle.own_share)
        .range(0, 1)
        .doc("Most share of a new triangle's samples that the map explains already.");
    params_.add("cosine_least", s.triangle.cosine_least)
        .range(0, 1)
        .doc("New triangles must face the camera at least so much (cosine of the angle of incidence).");
    params_.add("steep_cosine", s.triangle.steep_cosine)
        .range(0, 1)
        .doc(
            "New triangles that face the camera less than so much must also agree with the surface at their corners: a "
            "slanted "
            "surface does, a bridge over a depth jump does not.");
    params_.add("steep_agree", s.triangle.steep_agree)
        .range(-1, 1)
        .doc("Least mean cosine between such a triangle's normal and those at its corners.");
  }
  void add_holes() {
    params_.add("hole_edges", settings_.holes.edges_most)
        .range(0, 1000)
        .doc("Boundary loops of up to so many edges are closed; 0 = none.");
    params_.add("hole_perimeter", settings_.holes.perimeter_most)
        .unit("m")
        .range(0, 100)
        .doc("Boundary loops up to this length are closed.");
    params_.add("notch_angle", settings_.notches.angle_most)
        .unit("rad")
        .range(0, 3.141592653589793)
        .doc(
            "Two boundary edges that meet at a sharper angle are joined by a face: slits close like a zip. 0 = never.");
    params_.add("notch_edge", settings_.notches.edge_most)
        .unit("m")
        .range(0, 100)
        .doc("Only notches whose edges are shorter than this are joined.");
  }
  void add_votes() {
    params_.add("votes_ratio", settings_.votes.through_per_hit)
        .range(0, 1000)
        .doc(
            "A face goes when the pixels that saw through it outnumber those that hit it by this factor and "
            "votes_free.");
    params_.add("votes_cosine", settings_.votes.cosine_least)
        .range(0, 1)
        .doc("Pixels that meet a face at a smaller cosine of incidence do not speak for it.");
    params_.add("votes_free", settings_.votes.through_free)
        .range(0, 65535)
        .doc("Pixels that may see through a face before they count against it.");
    params_.add("votes_forget", settings_.votes.forget)
        .range(0, 1)
        .doc(
            "Share of a face's hits that each frame takes away in which it is only seen through: what stood for long "
            "and left goes soon.");
  }
  void add_excess() {
    params_.add_choice("excess", settings_.excess.learn, {{"learn", true}, {"none", false}})
        .doc(
            "Variance beyond that of texels and sensor: learn takes it face by face from how far measurements fall "
            "from "
            "what was predicted, none is the paper's form.");
    params_.add("excess_sigma", settings_.excess.prior_sigma)
        .unit("m")
        .range(0, 1)
        .doc("Its square root for the first faces of a map; later ones start with the mean over the faces in view.");
    params_.add("excess_hits", settings_.excess.prior_hits)
        .range(1, 1000000)
        .doc("Measurements that a face's first value counts for.");
    params_.add("excess_views", settings_.excess.least_views)
        .range(0, 65535)
        .doc(
            "A face learns only after about so many frames have seen it: frames that follow each other share the error "
            "of "
            "their poses.");
  }
  void add_color() {
    params_
        .add_choice("color_exposure", settings_.color.exposure,
                    {{"gain", ColorExposure::gain}, {"fixed", ColorExposure::fixed}})
        .doc(
            "For maps with colour: gain divides an image by how much brighter it is than what the map predicts, "
            "channel "
            "by channel, so that the map keeps the exposure it began with; fixed takes colours as they are, the "
            "paper's "
            "form.");
    params_.add("color_drift", settings_.color.drift)
        .range(0, 1)
        .doc(
            "Standard deviation by which a texel's colour may change between two images that see it, where 1 is the "
            "brightest: for lighting that changes. 0 is the paper's form, which weighs the first image like the last.");
  }
  void add_between() {
    params_.add_choice("between", between_, {{"texels", Between::texels}, {"nothing", Between::nothing}})
        .doc(
            "What the frames between keyframes change: texels lets the offsets of the faces in view read the image (in "
            "the gather form), nothing leaves the map as it is.");
  }
  static bool is_power_of_two(int n) { return (n & (n - 1)) == 0; }

  UpdateSettings settings_;
  Between between_ = Between::texels;
  PredictionPool completed_;
  PerWorker<VisibleFaces> seen_;
  PerWorker<UpdateScratch> scratch_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<PpmBayesUpdate>(
      "map_update.ppm_bayes",
      "Writes a frame into the mesh: Bayesian texel update, new surface stitched to the old, disproved faces removed.",
      "paper, section 4.3");
}
