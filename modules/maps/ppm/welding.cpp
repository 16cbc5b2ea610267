#include "modules/maps/ppm/welding.hpp"

#include <algorithm>

namespace ppm {
namespace {

void weld_vertices(const PpmMap& map, Welding& welding) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> number(map.vertex_ids(), kUnused);  // by vertex id
  for (const auto& chunk : map.table().chunks()) {
    const Geometry& geometry = *chunk.geometry;
    for (std::size_t v = 0; v < geometry.position.size(); ++v) {
      auto& n = number[geometry.vertex_id[v]];
      if (n != kUnused) continue;
      n = static_cast<std::uint32_t>(welding.position.size());
      welding.position.push_back(geometry.position[v]);
      welding.normal.push_back(geometry.normal[v]);
    }
    for (const auto& [a, b, c] : geometry.face)
      welding.face.push_back(
          {number[geometry.vertex_id[a]], number[geometry.vertex_id[b]], number[geometry.vertex_id[c]]});
  }
}

void weld_edges(const PpmMap& map, Welding& welding) {
  struct Side {
    std::array<std::uint32_t, 2> vertex;
    std::uint32_t face, k, divisions;
  };
  std::vector<Side> sides;
  sides.reserve(3 * welding.face.size());
  std::uint32_t f = 0;
  for (const auto& chunk : map.table().chunks())
    for (const std::uint32_t n : chunk.geometry->divisions) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto a = welding.face[f][k], b = welding.face[f][(k + 1) % 3];
        sides.push_back({{std::min(a, b), std::max(a, b)}, f, k, n});
      }
      ++f;
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.face < b.face;
  });
  welding.edges.resize(welding.face.size());
  for (const Side& side : sides) {
    if (welding.edge.empty() || welding.edge.back().vertex != side.vertex) welding.edge.push_back({side.vertex, 1, 0});
    WeldedEdge& edge = welding.edge.back();
    edge.divisions = std::max(edge.divisions, side.divisions);
    ++edge.faces;
    welding.edges[side.face][side.k] = static_cast<std::uint32_t>(welding.edge.size() - 1);
  }
}

}  // namespace

Welding weld(const PpmMap& map, WeldEdges edges) {
  Welding welding;
  weld_vertices(map, welding);
  if (edges == WeldEdges::yes) weld_edges(map, welding);
  return welding;
}

}  // namespace ppm
