#pragma once
#include <vector>

#include "framework/config/params.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

// What all predictors of views of mesh maps have in common.

/// The mesh map behind a map of a belief with the facet "map.ppm".
inline const PpmMap& as_ppm(const Map& map) {
  return static_cast<const PpmMap&>(map);
}
std::vector<const PpmMap*> as_ppm(const std::vector<const Map*>& maps);

/// Declares the parameters `backfaces` and `texel`, bound to the members.
void declare_mesh_view(Params& params, bool& cull_back_faces, bool& linear_texels);

}  // namespace ppm
