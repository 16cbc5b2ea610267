#pragma once
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/new_surface.hpp"

namespace ppm {

struct HoleSettings {
  int edges_most = 24;          ///< longer loops are left open
  float perimeter_most = 1.5f;  ///< m
  float cosine_least = 0.2f;    ///< between a filling face and the normals at its vertices
  SurfaceGate gate;
  float gate_sigmas = 4;  ///< a filling face is refused where the measurement at its centroid is farther behind it
};

/// Closes small loops of open edges whose vertices are all in the image, by clipping ears, the best shaped first. New
/// faces are added to the boundary and appended to `faces`. A loop that passes a vertex twice (a bow tie) is taken as
/// several.
void fill_holes(const UpdateView& view, const HoleSettings& settings, Boundary& boundary, std::vector<RimFace>& faces);

/// The loops: vertices in the order of their open edges, each vertex once, 3 to `edges_most` of them. Only vertices for
/// which usable[v] is set. Always the same for the same boundary.
std::vector<std::vector<std::uint32_t>> small_loops(const Boundary& boundary, const std::vector<std::uint8_t>& usable,
                                                    int edges_most);

}  // namespace ppm
