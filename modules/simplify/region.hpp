#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/described_surface.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

using Triangle = std::array<std::uint32_t, 3>;

/// Which faces of a map are to be simplified.
struct DueSettings {
  int hits_least = 10;       ///< only faces that were measured so often take part
  float share_least = 0.2f;  ///< a chunk is due when of its faces so many may take part and never did
};

/// The chunks that are due, ascending.
std::vector<std::uint32_t> due_chunks(const PpmMap& map, const DueSettings& settings);

/// The faces that take part, from all due chunks together, so that borders between such chunks are like any other place.
/// Vertices are numbered within the region, ascending ids. Refers to the map's texels.
struct Region {
  std::vector<FaceRef> face;                        ///< [F] ascending
  std::vector<TexturedFace> textured;               ///< [F]
  std::vector<Triangle> corner;                     ///< [F] vertices
  std::vector<std::uint32_t> id;                    ///< [V] the map's
  std::vector<Eigen::Vector3f> position;            ///< [V] m
  std::vector<Eigen::Vector3f> displaced;           ///< [V] m, on the described surface
  std::vector<std::uint8_t> locked;                 ///< [V] 1: other faces use it too, or two borders meet in it
  std::vector<std::array<std::uint32_t, 2>> outer;  ///< directed edges of other faces between vertices of the region
};
Region make_region(const PpmMap& map, const std::vector<std::uint32_t>& due, const DueSettings& settings);

}  // namespace ppm
