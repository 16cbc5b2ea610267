#pragma once
#include "framework/slam/mesh.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// The faces as they are; mean and variance at a vertex of the texels that lie on it.
Mesh base_mesh(const PpmMap& map);

/// The surface that the map describes: a vertex for each texel, moved along the interpolated vertex normal. Texels that
/// coincide, on edges and in vertices, become one vertex, and a side is divided as finely as the finer of its faces
/// divides it, so that the mesh has no cracks: its boundary is the image of the boundary of the base.
Mesh dense_mesh(const PpmMap& map);

}  // namespace ppm
