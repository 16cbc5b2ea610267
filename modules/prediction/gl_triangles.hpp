#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// A chunk's triangles as a rasterizer draws them that tells faces apart by a value of one of their vertices: vertex f
/// is a corner of face f and its last one, so that it stands for the face; vertices past the faces stand for none.
/// OpenGL takes what is flat from the last vertex of a triangle.
struct GlTriangles {
  std::vector<Eigen::Vector3f> position;           ///< [F + few] m, map frame
  std::vector<std::array<std::uint32_t, 3>> face;  ///< [F] wound like the chunk's

  explicit GlTriangles(const Geometry& geometry);
};

}  // namespace ppm
