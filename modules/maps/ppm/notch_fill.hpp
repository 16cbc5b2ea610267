#pragma once
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/new_surface.hpp"

namespace ppm {

struct NotchSettings {
  float angle_most = 2.6179939f;  ///< rad, on the open side, between the two edges of a notch
  float edge_most = 3.0f;         ///< m, longest edge of a filling face
  float cosine_least = 0.2f;      ///< between a filling face and the normals at its vertices
  TriangleSettings triangle;      ///< what the measurement must say
};

/// Closes notches of the boundary in the image: where two successive open edges meet at a sharp angle on the open side,
/// a face is put between them, which shortens the notch; so ragged borders get smooth, and slits between surfaces that
/// were made at different times close from their ends like a zip. New faces are added to the boundary and appended to
/// `faces`.
void fill_notches(const UpdateView& view, const std::vector<std::uint8_t>& classes, const NotchSettings& settings,
                  Boundary& boundary, std::vector<RimFace>& faces);

}  // namespace ppm
