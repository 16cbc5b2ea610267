#pragma once
#include <cstddef>
#include <memory>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// How vertices move to where the texels around them say that the surface is.
struct AdjustSettings {
  bool weighted = true;  ///< by information, and by how far a face's normal shows along the vertex's; false: plain mean
  int rings = 1;         ///< texels up to so many steps from the vertex count as around it; 0 = those that lie on it
  float sigmas = 2;      ///< a vertex moves when its offset is more than so many of its standard deviations ...
  float least = 0.005f;  ///< ... and more than this, m
  float most = 0.05f;    ///< m, longest step
  bool boundary = false;    ///< whether vertices on the mesh's boundary move too
  bool reexpress = true;    ///< texel means follow, so that the described surface stays; false: they are left alone
  float turn_most = 0.35f;  ///< rad; a face that would turn further keeps its vertices where they are
};

struct AdjustCounts {
  std::size_t moved = 0;    ///< vertices
  std::size_t refused = 0;  ///< vertices that would have moved but for the boundary or a face that would turn too far
  float farthest = 0;       ///< m, longest step made
};

/// Moves vertices along their normals by the mean of the texels around them, over all faces of all chunks, all at once.
/// No face turns by more than turn_most or shrinks below half its area. A pure function of its arguments. Where nothing
/// moves the map is returned as it came. Source: paper, section 4.3.
std::shared_ptr<const PpmMap> adjust_vertices(std::shared_ptr<const PpmMap> map, const AdjustSettings& settings,
                                              AdjustCounts* counts = nullptr);

}  // namespace ppm
