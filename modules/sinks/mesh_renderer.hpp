#pragma once
#include "framework/slam/mesh.hpp"
#include "modules/sinks/canvas.hpp"

namespace ppm {

/// What a mesh's colours say.
enum class MeshColor {
  shaded,       ///< lit surface, tinted by height
  uncertainty,  ///< standard deviation of the offset: from 0.2 mm (blue) to 5 cm (red), logarithmic
  normals       ///< direction of the normal
};

/// Draws the front faces of a mesh. up: unit, map frame. Edges sharper than 40 degrees stay sharp.
void draw_mesh(Canvas& canvas, const Mesh& mesh, MeshColor color, const Eigen::Vector3f& up);

/// The colour of a standard deviation, m.
Color uncertainty_color(float sigma_m);

}  // namespace ppm
