#pragma once
#include <string>
#include <vector>

#include "framework/slam/mesh.hpp"
#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// The bytes of a PLY file, binary little endian. A vertex: x y z nx ny nz mean sigma (float, metres), then red green
/// blue (uchar) unless `color` is empty; a face: vertex_indices (3 ints). color: [V].
/// Source: Turk, "The PLY polygon file format", 1994.
std::string to_ply(const Mesh& mesh, const std::vector<Color>& color);

}  // namespace ppm
