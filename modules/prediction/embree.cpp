#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"
#include "modules/prediction/mesh_view.hpp"

namespace {

using namespace ppm;

/// Predicts views of a mesh map by ray casting.
///
/// prediction  range to the base face (not to the described surface), texel mean and variance at the hit, the face's
///             normal; colour where the map has it; a face seen from its unobserved side is no hit unless `backfaces` says so
///
/// Nodes of one graph that build alike share the acceleration structures.
///
/// metrics     scenes, built (acceleration structures in use; built in this frame by this node), scenes_mb (of all nodes)
///
/// source      paper, section 4.2; Wald et al., "Embree", SIGGRAPH 2014
class EmbreePredictor final : public ViewPredictor {
 public:
  EmbreePredictor() : ViewPredictor("map.ppm") {
    params_.add("packet", view_.packet).doc("Rays traced together: 1, 4, 8 or 16.").check([this] {
      const bool known = view_.packet == 1 || view_.packet == 4 || view_.packet == 8 || view_.packet == 16;
      return known ? "" : "must be 1, 4, 8 or 16";
    });
    params_.add("coherent", view_.coherent).doc("Tell Embree that the rays of a packet go much the same way.");
    params_.add("robust", scene_.robust)
        .doc("Watertight test of ray against triangle: no ray slips between two faces.");
    params_.add_choice("build", scene_.build, {{"low", Build::low}, {"medium", Build::medium}, {"high", Build::high}})
        .doc("Quality of the acceleration structures: low builds fastest, high traces fastest.");
    declare_mesh_view(params_, view_.cull_back_faces, view_.linear_texels);
    params_.add_choice("rays", rays_, {{"image", Rays::image}, {"compared", Rays::compared}})
        .doc(
            "Which pixels get a ray: all of the image, or, when they are asked for, those that a weighting compares: "
            "cheaper where it compares few of a full image.");
  }

  void open(Context& context) override {
    ViewPredictor::open(context);
    scenes_.reset();
  }

  void before(Context& context) override {
    ViewPredictor::before(context);
    context.metric("scenes", static_cast<double>(scenes_->size()));
    context.metric("built", static_cast<double>(scenes_->built()));
    context.metric("scenes_mb", static_cast<double>(scenes_->bytes()) / 1e6);
  }

  void prepare(const std::vector<const Map*>& maps, const Workers& workers) override {
    if (!scenes_) scenes_ = std::make_unique<EmbreeScenes>(scene_);
    scenes_->update(as_ppm(maps), workers);
  }

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    if (rays_ == Rays::compared) {
      auto rays = on_demand_.take();
      rays->start(as_ppm(map), scenes_->of(as_ppm(map)), view_, out);
      return rays;
    }
    auto view = views_.take();
    view->start(as_ppm(map), view_.linear_texels, static_cast<std::size_t>(out.camera.pixels()));
    return view;
  }

  void predict(const Map& map, const Rows& rows, Prediction& out, int) const override {
    if (rays_ == Rays::compared) return;
    trace_hits(as_ppm(map), scenes_->of(as_ppm(map)), view_, rows, out,
               static_cast<ElementView&>(*out.deferred).hits());
  }

 private:
  using Build = EmbreeOptions::Build;
  EmbreeOptions scene_;
  EmbreeViewOptions view_;
  enum class Rays { image, compared } rays_ = Rays::image;
  mutable Pool<ElementView> views_;
  mutable Pool<EmbreeRays> on_demand_;
  std::unique_ptr<EmbreeScenes> scenes_;  // made on first use: the options are known only then
};

}  // namespace

PPM_MODULES(r) {
  r.add<EmbreePredictor>("prediction.embree",
                         "What each particle should see of its mesh map, by ray casting with Embree.",
                         "paper, section 4.2; Wald et al., Embree, SIGGRAPH 2014");
}
