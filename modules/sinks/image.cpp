#include <array>
#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/sinks/mesh_renderer.hpp"
#include "modules/sinks/output_name.hpp"
#include "modules/sinks/overview.hpp"
#include "modules/sinks/path_drawing.hpp"
#include "modules/sinks/png_encoder.hpp"

namespace ppm {
namespace {

enum class Up { automatic, x, minus_x, y, minus_y, z, minus_z };

/// Draws the best particle's map and the particles' paths from outside, whenever the node runs. Needs no display.
class MapImage final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.*"}, {}, {}}};

  MapImage() {
    params_.add("file", file_).doc(kOutputNameDoc);
    params_.add("cols", cols_).range(16, 8192).doc("Width of the picture.");
    params_.add("rows", rows_).range(16, 8192).doc("Height of the picture.");
    params_
        .add_choice(
            "color", color_,
            {{"shaded", MeshColor::shaded}, {"uncertainty", MeshColor::uncertainty}, {"normals", MeshColor::normals}})
        .doc(
            "What colours say: a lit surface tinted by height; the standard deviation of the surface's offset, 0.2 mm "
            "(blue) to 5 cm (red), logarithmic; or the direction of normals.");
    params_.add_choice("surface", surface_, {{"base", Surface::base}, {"displaced", Surface::displaced}})
        .doc("The elements as they are, or moved by the means of their texels.");
    params_.add("azimuth", azimuth_)
        .unit("rad")
        .range(-7, 7)
        .doc("Where the view is from: angle to the direction of the walls, in the quarter that shows most surface.");
    params_.add("elevation", elevation_).unit("rad").range(0, 1.57).doc("Height of the view above the horizon.");
    params_
        .add_choice("up", up_,
                    {{"auto", Up::automatic},
                     {"x", Up::x},
                     {"-x", Up::minus_x},
                     {"y", Up::y},
                     {"-y", Up::minus_y},
                     {"z", Up::z},
                     {"-z", Up::minus_z}})
        .doc("The map frame's axis that points upwards; auto: found from the cameras' attitude and the floor.");
    params_.add("paths", paths_).doc("Draws the paths.");
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const Mesh mesh = belief->map[best]->mesh(surface_);
    std::vector<Pose> path;
    for (const auto& pose : belief->trajectory[best].poses()) path.push_back(pose.T_map_camera);
    const Eigen::Vector3d up = up_direction(mesh, path);
    const View view = overview(mesh, path, up, azimuth_, elevation_, cols_, rows_);
    Canvas canvas(view.camera, view.T_map_camera, kSamples);
    draw_mesh(canvas, mesh, color_, up.cast<float>());
    canvas.shade_depth_edges(kDepthEdges);
    if (paths_) draw_paths(canvas, *belief, rows_ / 960.0);
    const auto image = canvas.resolve(Color(1, 1, 1), Color(0.90f, 0.92f, 0.95f));
    write_file(context.output(output_name(file_, context.frame())), to_png(image));
  }

 private:
  Eigen::Vector3d up_direction(const Mesh& mesh, const std::vector<Pose>& path) const {
    if (up_ == Up::automatic) return estimate_up(mesh, path);
    const int number = static_cast<int>(up_) - 1;
    return Eigen::Vector3d::Unit(number / 2) * (number % 2 == 0 ? 1.0 : -1.0);
  }

  static constexpr int kSamples = 3;  // per pixel and axis
  static constexpr float kDepthEdges = 12;
  std::string file_ = "map.png";
  int cols_ = 1280, rows_ = 960;
  MeshColor color_ = MeshColor::shaded;
  Surface surface_ = Surface::displaced;
  double azimuth_ = 0.6, elevation_ = 0.75;
  Up up_ = Up::automatic;
  bool paths_ = true;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MapImage>(
      "sink.image", "Draws the best particle's map and the particles' paths as a picture (PNG).",
      "Boucheny, \"Visualisation scientifique de grands volumes de donnees\", 2009 (eye-dome lighting)");
}
