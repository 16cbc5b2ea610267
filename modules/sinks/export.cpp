#include "modules/maps/export/export.hpp"

#include <string>

#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/sinks/color_params.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

/// Writes the best particle's map in a format of other programs whenever the node runs: as `ppm export` does.
class Export final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.*"}, {}, {}}};

  Export() {
    settings_.format = ExportFormat::glb;
    params_.add("file", file_).doc(kOutputNameDoc).check([this]() -> std::string {
      const auto format = format_of(file_);
      if (!format) return "'" + file_ + "' has no ending that names a format: .ply, .obj, .glb, .vdb or .png";
      settings_.format = *format;
      return "";
    });
    params_.add_choice("surface", settings_.surface, {{"base", Surface::base}, {"displaced", Surface::displaced}})
        .doc("The faces with their texture, or the surface that the map describes.");
    colors_.declare(params_);
    params_.add("voxel", settings_.voxel_m).unit("m").above(0).doc("Edge of a voxel in a VDB file.");
    params_.add_choice("up", settings_.picture.up, up_names())
        .doc("The map frame's axis that points upwards, for formats that have one; auto: found from the cameras' "
             "attitude and the floor.");
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const Map& map = *belief->map[best];
    ExportSettings settings = settings_;
    for (const auto& pose : belief->trajectory[best].poses()) settings.path.push_back(pose.T_map_camera);
    settings.show = colors_.show(map.mesh(Surface::base), context);
    settings.picture.range = colors_.range();
    write(export_map(map, settings, context.output(output_name(file_, context.frame())), context.node()));
  }

 private:
  std::string file_ = "map.glb";
  ExportSettings settings_;
  ColorParams colors_{Show::sigma};
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::Export>("sink.export",
                     "Writes the best particle's map in a format of other programs, named by the file's ending: PLY, "
                     "OBJ, GLB, VDB or a picture.",
                     "Khronos Group, \"glTF 2.0 Specification\", ISO/IEC 12113:2022");
}
