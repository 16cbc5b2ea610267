#include "modules/maps/picture/map_picture.hpp"

#include "modules/maps/picture/legend.hpp"
#include "modules/maps/picture/mesh_renderer.hpp"

namespace ppm {
namespace {

constexpr int kSamples = 3;  // per pixel and axis
constexpr float kDepthEdges = 12;
constexpr double kTanHalfWidth = 0.767;  // 75 degrees

View view_from(const Pose& T_map_camera, int cols, int rows) {
  const double focal = cols / (2 * kTanHalfWidth);
  return {{cols, rows, focal, focal, (cols - 1) / 2.0, (rows - 1) / 2.0}, T_map_camera};
}

}  // namespace

RgbImage map_picture(const Mesh& mesh, const std::vector<Pose>& path, const PictureSettings& settings,
                     const std::function<void(Canvas&)>& draw_over) {
  const Eigen::Vector3d up = up_direction(settings.up, mesh, path);
  const View view = settings.T_map_camera
                        ? view_from(*settings.T_map_camera, settings.cols, settings.rows)
                        : overview(mesh, path, up, settings.azimuth_rad, settings.elevation_rad, settings.cols,
                                   settings.rows);
  const auto scale = scale_for(mesh, settings.show, settings.range);
  Canvas canvas(view.camera, view.T_map_camera, kSamples);
  draw_mesh(canvas, mesh, settings.show, scale, up.cast<float>());
  canvas.shade_depth_edges(kDepthEdges);
  if (settings.edges) draw_edges(canvas, mesh, settings.rows / 960.0);
  if (draw_over) draw_over(canvas);
  RgbImage image = canvas.resolve(Color(1, 1, 1), Color(0.90f, 0.92f, 0.95f));
  if (scale) draw_legend(image, *scale);
  return image;
}

}  // namespace ppm
