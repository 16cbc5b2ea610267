#pragma once
#include <cstddef>
#include <memory>

#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/texel_bend.hpp"

namespace ppm {

/// How a face is divided to make room for a new vertex.
enum class SplitForm {
  bisect,  ///< at the middle of the longest edge around it, together with the face beyond: no slivers arise
  insert,  ///< where the error is largest, into three: the paper's form
};

struct RemeshSettings {
  SplitForm form = SplitForm::bisect;
  BendSettings bend;
  float edge_least = 0.1f;  ///< m; faces whose longest edge is shorter are left to their texels
  float turn_most = 0.8f;   ///< rad; a new face turns no further from the one it replaces
};

struct RemeshCounts {
  std::size_t bent = 0;       ///< faces that asked to be divided
  std::size_t inserted = 0;   ///< vertices
  std::size_t new_faces = 0;  ///< faces in place of those divided
};

/// Inserts vertices, on the described surface, where the texels of a face say with certainty that it should bend, the
/// worst first; each face is divided at most once, so that a deep bend takes several calls. New faces take over the
/// described surface; their evidence is that of the old ones by area. A pure function of its arguments. Where nothing
/// is divided the map is returned as it came. Source: paper, section 4.3; bisection: Rivara, "New longest-edge
/// algorithms for the refinement and/or improvement of unstructured triangulations", Int. J. Numer. Meth. Engng. 1997.
std::shared_ptr<const PpmMap> remesh(std::shared_ptr<const PpmMap> map, const RemeshSettings& settings,
                                     RemeshCounts* counts = nullptr);

}  // namespace ppm
