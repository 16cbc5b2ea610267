#pragma once
#include <optional>

#include "framework/slam/mesh.hpp"
#include "modules/maps/picture/canvas.hpp"
#include "modules/maps/picture/color_scale.hpp"

namespace ppm {

/// Draws the front faces of a mesh, lit (normals: as they are). up: unit, map frame. scale: for sigma and mean. Edges
/// sharper than 40 degrees stay sharp. Show::color needs a mesh with colours (InternalError).
void draw_mesh(Canvas& canvas, const Mesh& mesh, Show show, const std::optional<ColorScale>& scale,
               const Eigen::Vector3f& up);
/// Draws the edges of the faces over them.
void draw_edges(Canvas& canvas, const Mesh& mesh, double width_px);

}  // namespace ppm
