#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace ppm {

/// The nodes of a face that is to be cut into small triangles: those on its three sides, as many as its neighbour
/// needs, and inside those of its own texels.
struct FaceNodes {
  std::uint32_t divisions = 1;  ///< of the face's own texels
  /// Side k from corner k to the next, both included: at least divisions + 1 nodes, equally spaced.
  std::array<std::vector<std::uint32_t>, 3> side;
  /// The texels (i, j) with i, j >= 1 and i + j < divisions have the numbers first_inside + texel_index(divisions - 3,
  /// i - 1, j - 1).
  std::uint32_t first_inside = 0;
};

/// Appends triangles that fill the face exactly, wound like it: each node is used, and no node lies inside a triangle's
/// edge. So faces that share their side's nodes meet without cracks, however they divide it.
void tile_face(const FaceNodes& nodes, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace ppm
