#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/gl_views.hpp"
#include "modules/prediction/mesh_view.hpp"

namespace {

using namespace ppm;

/// Predicts views of a mesh map with OpenGL, without a display: the device finds which face each pixel shows, the
/// processor where its ray meets that face, and the texels there.
///
/// prediction  range to the base face (not to the described surface), texel mean and variance at the hit, the face's
///             normal; colour where the map has it; a face seen from its unobserved side is no hit unless `backfaces`
///             says so
///
/// metrics     chunks (on the device), added (to it in this frame), device_mb
///
/// throws      Error where no device can draw
///
/// source      paper, section 5
class GlPredictor final : public ViewPredictor {
 public:
  GlPredictor() : ViewPredictor("map.ppm") {
    declare_mesh_view(params_, options_.cull_back_faces, linear_texels_);
    params_.add("views_per_draw", options_.views_per_draw)
        .range(1, GlRasterizer::kMostViews)
        .doc("Particles whose views are drawn together.");
    params_
        .add_choice("device", options_.device,
                    {{"any", GlDevice::any}, {"hardware", GlDevice::hardware}, {"software", GlDevice::software}})
        .doc("What draws: hardware; software, which is Mesa's llvmpipe on the processor; or any, hardware first.");
  }

  void open(Context& context) override {
    ViewPredictor::open(context);
    views_.reset();
    gl();
    context.log().info("{}: OpenGL by {}", context.node(), gl().renderer());
  }

  void close(Context&) override { views_.reset(); }

  void before(Context& context) override {
    ViewPredictor::before(context);
    const GlMeshes& meshes = gl().meshes();
    context.metric("chunks", static_cast<double>(meshes.size()));
    context.metric("added", static_cast<double>(meshes.added()));
    context.metric("device_mb", static_cast<double>(meshes.bytes()) / 1e6);
  }

  void prepare(const std::vector<const Map*>& maps, const Workers&) override {
    gl().update(as_ppm(maps));
  }

  void expect(const Camera& camera, const std::vector<ExpectedView>& expected) override {
    std::vector<GlView> views;
    views.reserve(expected.size());
    for (const auto& view : expected) views.push_back({&as_ppm(*view.map), nullptr, view.T_map_camera});
    gl().expect(camera, std::move(views));
  }

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    const PpmMap& mesh = as_ppm(map);
    return std::make_shared<FaceView>(mesh, linear_texels_, views_->faces(mesh, out.camera, out.T_map_camera));
  }

  /// defer() drew all rows.
  void predict(const Map&, const Rows&, Prediction&, int) const override {}

 private:
  // The device is opened on first use: options are known only then.
  GlViews& gl() {
    if (!views_) views_ = std::make_unique<GlViews>(options_);
    return *views_;
  }

  GlViewOptions options_;
  bool linear_texels_ = true;
  std::unique_ptr<GlViews> views_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<GlPredictor>("prediction.raster_gl",
                     "What each particle should see of its mesh map, drawn by OpenGL without a display.",
                     "paper, section 5");
}
