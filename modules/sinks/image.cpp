#include <algorithm>
#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/picture/map_picture.hpp"
#include "modules/maps/picture/path_drawing.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/sinks/color_params.hpp"
#include "modules/sinks/output_name.hpp"

namespace ppm {
namespace {

enum class From { outside, camera };

std::vector<Pose> poses_of(const Trajectory& trajectory) {
  std::vector<Pose> poses;
  for (const auto& pose : trajectory.poses()) poses.push_back(pose.T_map_camera);
  return poses;
}

/// The paths of all particles thinly, each once, under the best one's.
void draw_paths(Canvas& canvas, const ParticleSet& belief, const std::vector<Pose>& best, double scale) {
  std::vector<std::vector<Eigen::Vector3d>> lines;
  for (auto path = belief.trajectory.begin(); path != belief.trajectory.end(); ++path) {
    if (std::find(belief.trajectory.begin(), path, *path) != path) continue;
    auto& line = lines.emplace_back();
    for (const auto& T : poses_of(*path)) line.push_back(T.translation());
  }
  canvas.polylines(lines, {{0.25f, 0.35f, 0.60f}, 1.0 * scale, 0.35f, 0.12f});
  draw_path(canvas, best, scale);
}

/// Draws the best particle's map and the particles' paths, whenever the node runs. Needs no display.
class MapImage final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.*"}, {}, {}}};

  MapImage() {
    params_.add("file", file_).doc(kOutputNameDoc);
    params_.add("cols", settings_.cols).range(16, 8192).doc("Width of the picture.");
    params_.add("rows", settings_.rows).range(16, 8192).doc("Height of the picture.");
    colors_.declare(params_);
    params_.add_choice("surface", surface_, {{"base", Surface::base}, {"displaced", Surface::displaced}})
        .doc("The elements as they are, or the surface that the map describes.");
    params_.add_choice("from", from_, {{"outside", From::outside}, {"camera", From::camera}})
        .doc("Where the view is from: outside and above, showing all; or the camera's pose.");
    params_.add("azimuth", settings_.azimuth_rad)
        .unit("rad")
        .range(-7, 7)
        .doc("From outside: angle to the direction of the walls, in the quarter that shows most surface.");
    params_.add("elevation", settings_.elevation_rad)
        .unit("rad")
        .range(0, 1.57)
        .doc("From outside: height of the view above the horizon.");
    params_.add_choice("up", settings_.up, up_names())
        .doc("The map frame's axis that points upwards; auto: found from the cameras' attitude and the floor.");
    params_.add("paths", paths_).doc("Draws the paths.");
    params_.add("edges", settings_.edges).doc("Draws the edges of the faces.");
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const Mesh mesh = belief->map[best]->mesh(surface_);
    const std::vector<Pose> path = poses_of(belief->trajectory[best]);
    PictureSettings settings = settings_;
    settings.show = colors_.show(mesh, context);
    settings.range = colors_.range();
    if (from_ == From::camera && !path.empty()) settings.T_map_camera = path.back();
    const auto draw = [&](Canvas& canvas) { draw_paths(canvas, *belief, path, settings.rows / 960.0); };
    const auto image = map_picture(mesh, path, settings, paths_ ? std::function<void(Canvas&)>(draw) : nullptr);
    write_file(context.output(output_name(file_, context.frame())), to_png(image));
  }

 private:
  std::string file_ = "map.png";
  PictureSettings settings_;
  ColorParams colors_{Show::shaded};
  Surface surface_ = Surface::displaced;
  From from_ = From::outside;
  bool paths_ = true;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MapImage>(
      "sink.image", "Draws the best particle's map and the particles' paths as a picture (PNG).",
      "Boucheny, \"Visualisation scientifique de grands volumes de donnees\", 2009 (eye-dome lighting)");
}
