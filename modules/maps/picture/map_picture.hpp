#pragma once
#include <functional>
#include <optional>

#include "modules/maps/picture/canvas.hpp"
#include "modules/maps/picture/color_scale.hpp"
#include "modules/maps/picture/up.hpp"

namespace ppm {

struct PictureSettings {
  int cols = 1280, rows = 960;
  Show show = Show::shaded;
  std::optional<ScaleRange> range;  ///< of the colours of sigma and mean; none: the mesh's own
  double azimuth_rad = 0.6, elevation_rad = 0.75;
  Up up = Up::automatic;
  std::optional<Pose> T_map_camera;  ///< a view from there, 75 degrees wide; none: from outside and above, see overview()
  bool edges = false;                ///< draws the edges of faces
};

/// A picture of a mesh, with the legend of its colours. path: of the camera; draw_over: adds lines, may be empty.
/// Show::color needs a mesh with colours (InternalError).
RgbImage map_picture(const Mesh& mesh, const std::vector<Pose>& path, const PictureSettings& settings,
                     const std::function<void(Canvas&)>& draw_over);

}  // namespace ppm
