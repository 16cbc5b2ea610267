#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/splats.hpp"

namespace {

using namespace ppm;

/// Draws each particle's points as discs.
/// belief  map.points; gives range (to the discs' mean along the ray), normal, and variance: the discs' own and their scatter
/// A pixel that no disc covers is a miss.
/// source  Pfister et al., SIGGRAPH 2000; Zwicker et al., SIGGRAPH 2001
class PointSplats final : public ViewPredictor {
 public:
  PointSplats() : ViewPredictor("map.points") {
    params_.add("blend", settings_.blend_m)
        .unit("m")
        .range(0, 1)
        .doc("Discs so far behind the foremost one along the ray are of its surface, and the mean of them is shown.");
    params_.add("blend_sigmas", settings_.blend_sigmas)
        .range(0, 100)
        .doc("So are those within so many of its standard deviations, where that is more.");
  }

  void prepare(const std::vector<const Map*>&, const Workers& workers) override { drawing_.resize(workers.threads()); }
  void predict(const Map& map, const Rows& rows, Prediction& out, int worker) const override {
    drawing_[worker].draw(static_cast<const PointMap&>(map), settings_, rows, out);
  }

 private:
  SplatSettings settings_;
  mutable PerWorker<SplatDrawing> drawing_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<PointSplats>("prediction.points", "Predicts views of a point map: discs along its points' normals, blended where they overlap.",
                     "Pfister et al., \"Surfels\", SIGGRAPH 2000; Zwicker et al., \"Surface splatting\", SIGGRAPH 2001");
}
