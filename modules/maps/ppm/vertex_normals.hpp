#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/vertex_finder.hpp"

namespace ppm {

/// A normal that a copy of a vertex should have.
struct CopyNormal {
  VertexCopy copy;
  Eigen::Vector3f normal;
};

/// Area-weighted normals of some vertices (ascending ids, each once, with their positions) over all their faces in all
/// chunks: one entry a copy, all copies of a vertex alike. Where the faces around a vertex cancel, it gets its first
/// face's normal.
std::vector<CopyNormal> vertex_normals(const PpmMap& map, std::span<const NewVertex> vertices);

}  // namespace ppm
