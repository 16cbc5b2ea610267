#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/raster_drawing.hpp"

namespace {

using namespace ppm;

const PpmMap& as_ppm(const Map& map) {
  return static_cast<const PpmMap&>(map);
}

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
    params_.add_choice("backfaces", options_.cull_back_faces, {{"cull", true}, {"hit", false}})
        .doc(
            "What a ray does at a face whose observed side looks away from it: cull lets it go on, hit stops it "
            "there.");
    params_.add_choice("texel", options_.linear_texels, {{"nearest", false}, {"linear", true}})
        .doc("Mean and variance at a hit: of the nearest texel, or interpolated between texels.");
  }

  void prepare(const std::vector<const Map*>&, const Workers& workers) override { scratch_.resize(workers.threads()); }

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    auto view = views_.take();
    view->start(as_ppm(map), out, options_);
    return view;
  }

  void predict(const Map&, const Rows& rows, Prediction& out, int worker) const override {
    draw_rows(rows, static_cast<RasterView&>(*out.deferred), scratch_[worker]);
  }

 private:
  RasterOptions options_;
  mutable Pool<RasterView> views_;
  mutable PerWorker<RasterScratch> scratch_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<RasterPredictor>(
      "prediction.raster",
      "What each particle should see of its mesh map, by drawing its triangles with SIMD instructions.",
      "paper, section 5; Olano and Greer, Graphics Hardware 1997; Pineda, SIGGRAPH 1988");
}
