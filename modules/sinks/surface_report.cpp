#include "modules/maps/ppm/surface_report.hpp"

#include <nlohmann/json.hpp>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

/// Says whether the best particle's mesh is one layer without cracks, whenever the node runs.
/// frame  gives the camera whose random pixels the rays go through, from random poses of the particle's path
class SurfaceReportSink final : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives the camera that the random rays are of."};
  In<Belief> belief{this, {{"belief", "map.ppm"}, {}, {}}};

  SurfaceReportSink() {
    params_.add("file", file_).doc(kOutputNameDoc);
    params_.add("rays", rays_).range(1, 100'000'000).doc("Number of random rays.");
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const auto& map = static_cast<const PpmMap&>(*belief->map[best]);
    const SurfaceReport r =
        report_surface(map, frame->camera, belief->trajectory[best].poses(), rays_, context.rng("rays"));
    const nlohmann::ordered_json json = {{"faces", r.faces},
                                         {"area_m2", r.area_m2},
                                         {"boundary_edges", r.boundary_edges},
                                         {"boundary_edges_per_m2", r.boundary_edges_per_m2()},
                                         {"non_manifold_edges", r.non_manifold_edges},
                                         {"rays_that_hit", r.rays},
                                         {"second_layers", r.second_layer_share()}};
    write_file(context.output(output_name(file_, context.frame())), json.dump(2) + "\n");
    context.metric("boundary_edges_per_m2", r.boundary_edges_per_m2());
    context.metric("non_manifold_edges", static_cast<double>(r.non_manifold_edges));
    context.metric("second_layers", r.second_layer_share());
  }

 private:
  std::string file_ = "surface.json";
  int rays_ = 20'000;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::SurfaceReportSink>("sink.surface_report",
                                "Writes whether the best particle's mesh is one layer: boundary and non-manifold "
                                "edges, second layers of surface.",
                                "The definitions are the project's own: docs/metrics.md");
}
