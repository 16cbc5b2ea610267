#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/mesh_view.hpp"
#include "modules/prediction/raster_drawing.hpp"

namespace {

using namespace ppm;

/// Predicts views of a mesh map by drawing its triangles on the processor: which triangle each pixel shows first, what
/// is known of it when asked. The same answers as prediction.embree's, without acceleration structures.
///
/// prediction  as of prediction.embree
///
/// source      paper, section 5; Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988; Olano and
///             Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", Graphics Hardware 1997
class RasterPredictor final : public ViewPredictor {
 public:
  RasterPredictor() : ViewPredictor("map.ppm") {
    declare_mesh_view(params_, options_.cull_back_faces, options_.linear_texels);
  }

  void prepare(const std::vector<const Map*>&, const Workers& workers) override { drawer_.prepare(workers); }

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    return drawer_.start(as_ppm(map), out, options_);
  }

  void predict(const Map&, const Rows& rows, Prediction& out, int worker) const override {
    drawer_.draw(rows, out, worker);
  }

 private:
  RasterOptions options_;
  mutable RasterDrawer drawer_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<RasterPredictor>(
      "prediction.raster",
      "What each particle should see of its mesh map, by drawing its triangles with SIMD instructions.",
      "paper, section 5; Olano and Greer, Graphics Hardware 1997; Pineda, SIGGRAPH 1988");
}
