#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/export/ply.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

/// Writes the best particle's map as a mesh whenever the node runs.
class MeshPly final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.*"}, {}, {}}};

  MeshPly() {
    params_.add("file", file_).doc(kOutputNameDoc);
    params_.add_choice("surface", surface_, {{"base", Surface::base}, {"displaced", Surface::displaced}})
        .doc("The elements as they are, or the surface that the map describes: for a mesh map a vertex for each texel.");
  }

  void tick(Context& context) override {
    const Mesh mesh = belief->map[belief->best()]->mesh(surface_);
    write_file(context.output(output_name(file_, context.frame())), to_ply(mesh, mesh.color));
  }

 private:
  std::string file_ = "map.ply";
  Surface surface_ = Surface::displaced;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MeshPly>("sink.mesh_ply",
                      "Writes the best particle's map as a PLY mesh with normals, mean and sigma of the offset per vertex.",
                      "Turk, \"The PLY polygon file format\", 1994");
}
