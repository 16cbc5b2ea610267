#include <cmath>
#include <memory>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/vdb_view.hpp"

namespace {

using namespace ppm;

/// Predicts views of an occupancy grid by following rays through its tree: over what is absent, unknown or free in one
/// step, voxel by voxel where a leaf holds anything else.
///
/// prediction  range to the surface; mean 0; variance of the log odds' profile along the ray (a logistic distribution
///             whose scale is the way on which they rise by 1), of the cells' size and of surface_sigma, turned to the normal; normal
///             down the gradient of the log odds, towards the camera; chunk: the tile, face: the voxel in it. A ray that
///             meets nothing occupied is a miss, through free space as through unknown. Rays are followed when a pixel
///             is asked for: a likelihood that compares few pixels costs few rays.
///
/// source      Amanatides, Woo, Eurographics 1987; Museth, SIGGRAPH 2014 talks (the walk); Loop, Cai, Orts-Escolano,
///             Chou, "A closed-form Bayesian fusion equation using occupancy probabilities", 3DV 2016 (surface where the
///             log odds cross 0)
class VdbDda final : public ViewPredictor {
 public:
  VdbDda() : ViewPredictor("map.vdb") {
    params_
        .add_choice("surface", options_.surface,
                    {{"crossing", VoxelSurface::crossing}, {"cell", VoxelSurface::cell}, {"expected", VoxelSurface::expected}})
        .doc(
            "Where a ray meets the surface: crossing is where the log odds, linear between the cells, rise above 0; cell "
            "is the centre of the first occupied cell, as plain grids have it; expected is the mean over the cells around "
            "it, each by its probability of being the first that is occupied.");
    params_.add("cell_sigma", options_.cell_sigma)
        .range(0, 10)
        .doc("Standard deviation of the surface for the cells' size, in cells, beside that of the log odds' profile.");
    params_.add("surface_sigma", surface_sigma_)
        .unit("m")
        .range(0, 1)
        .doc("And for what the grid cannot know, whatever its cells: errors of the poses that it was mapped from.");
    params_.add("normal_reach", options_.normal_reach)
        .range(0.5, 4)
        .doc("Normals are central differences over so many cells to either side.");
  }

  void prepare(const std::vector<const Map*>&, const Workers&) override {}

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    auto view = views_.take();
    const auto& grid = static_cast<const VdbMap&>(map);
    VoxelRayOptions options = options_;
    options.cell_sigma = static_cast<float>(std::hypot(options_.cell_sigma, surface_sigma_ / grid.settings().voxel_size_m));
    view->start(grid, options, out);
    return view;
  }

  void predict(const Map&, const Rows&, Prediction&, int) const override {}

 private:
  VoxelRayOptions options_;
  double surface_sigma_ = 0.008;
  mutable Pool<VdbView> views_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<VdbDda>("prediction.vdb_dda", "What each particle should see of its occupancy grid, by hierarchical ray walking.",
                "Museth, SIGGRAPH 2014 talks; Amanatides, Woo, Eurographics 1987; Loop et al., 3DV 2016");
}
