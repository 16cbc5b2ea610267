#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

// Changes within one chunk, in place: the steps that PpmEdit::commit() is made of. Between them the chunk may break
// invariants (vertices without faces, an old box); open edges are kept right by every step. All keep the order of what
// stays.

using Edge = std::array<std::uint32_t, 2>;

/// A face that is to be added: its vertices' ids, and its texels in the order of texel_index.
struct NewFace {
  std::array<std::uint32_t, 3> id;
  std::uint8_t divisions = 1;
  FaceEvidence evidence;
  TexelView texels;
  bool settled = false;
};
struct NewVertex {
  std::uint32_t id = 0;
  Eigen::Vector3f position;
};

/// Removes faces (ascending, each once) with their texels and evidence. Vertices stay.
void remove_faces(Geometry& geometry, Texels& texels, std::span<const std::uint32_t> faces);
/// Adds vertices that the chunk does not have yet (ascending ids, each once); faces are renumbered.
void insert_vertices(Geometry& geometry, std::span<const NewVertex> vertices);
/// Adds faces after those that are there. All their vertices must be in the chunk.
void append_faces(Geometry& geometry, Texels& texels, std::span<const NewFace> faces);
/// Removes vertices that no face uses; faces are renumbered.
void drop_unused_vertices(Geometry& geometry);
/// The box of the positions.
Eigen::AlignedBox3f bounding_box(const Geometry& geometry);
/// The directed edges (vertex ids) of some faces, ascending.
std::vector<Edge> sorted_edges(const Geometry& geometry, std::span<const std::uint32_t> faces);
/// The directed edges of all faces without a partner, ascending: what open_edge must be.
std::vector<Edge> open_edges(const Geometry& geometry);

}  // namespace ppm
