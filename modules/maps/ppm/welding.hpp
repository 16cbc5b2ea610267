#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// An edge of the whole mesh, with its one or two faces.
struct WeldedEdge {
  std::array<std::uint32_t, 2> vertex{};  ///< ascending
  std::uint32_t divisions = 1;            ///< of the face that divides it most
  std::uint32_t faces = 0;                ///< 1: on the boundary; 2: inside
};

/// The vertices and edges of a map, each once, however many chunks have a copy of it. Faces are numbered through all
/// chunks, in their order.
struct Welding {
  std::vector<Eigen::Vector3f> position;            ///< [V] m, map frame
  std::vector<Eigen::Vector3f> normal;              ///< [V] unit
  std::vector<std::array<std::uint32_t, 3>> face;   ///< [F] vertices, counter-clockwise from free space
  std::vector<WeldedEdge> edge;                     ///< [E]; empty unless asked for
  std::vector<std::array<std::uint32_t, 3>> edges;  ///< [F] edges k: from corner k to the next
};

enum class WeldEdges { no, yes };
Welding weld(const PpmMap& map, WeldEdges edges);

}  // namespace ppm
