#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/disparity_quadtree.hpp"
#include "modules/maps/ppm/triangle_test.hpp"

namespace ppm {

struct NewSurfaceSettings {
  QuadtreeSettings leaves;
  int smooth_radius = 1;  ///< px, of the smoothing of disparity that leaves are fitted to
  float smooth_sigmas = 3;
  float corner_sigmas = 3;        ///< a leaf's corner must fit its own pixel to so many sigmas
  float gap_vertex_px = 0.7f;     ///< corners nearer to a boundary vertex are dropped, and ...
  float gap_vertex_leaf = 0.25f;  ///< ... those nearer than so many leaf sizes
  float gap_edge_px = 0.6f;       ///< corners nearer to a boundary edge are dropped
  TriangleSettings triangle;
};

/// A face over vertices of a Boundary, wound so that its normal faces the camera.
using RimFace = std::array<std::uint32_t, 3>;

/// Makes surface where `wanted` [px] is set: flat leaves of the disparity image, their corners triangulated together
/// with the boundary vertices of the map that are seen there, so that new surface is stitched to the old. New vertices
/// and faces are added to the boundary; the faces are appended to `faces`. classes: of the pixels (see
/// classify_pixels).
void make_surface(const UpdateView& view, const std::vector<std::uint8_t>& classes,
                  const std::vector<std::uint8_t>& wanted, const NewSurfaceSettings& settings, Boundary& boundary,
                  std::vector<RimFace>& faces);

}  // namespace ppm
