#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace ppm {

/// Triangles with shared corners, as a file has them: no order, no orientation and no connection is promised.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> position;          ///< [vertices] m, finite
  std::vector<std::array<std::uint32_t, 3>> face;  ///< [faces] indices of position
};

/// Reads a mesh from a PLY file, ascii or binary little endian: x, y, z of the element "vertex" and the list
/// "vertex_indices" or "vertex_index" of the element "face". Faces with more than three corners are cut into a fan; whatever
/// else the file holds is skipped.
/// throws  DataError naming the file and the line (header, ascii) or the byte (binary): not PLY, big endian, an element or
///         property missing, a file that ends early, a corner that is not finite or not there, no face
/// source  Turk, "The PLY polygon file format", 1994
TriangleMesh read_ply_mesh(const std::filesystem::path& file);

}  // namespace ppm
