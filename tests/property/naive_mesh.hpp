#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm::test {

/// A mesh map without chunks and without sharing: what a map should hold, in the simplest form there is.
struct NaiveMesh {
  struct Face {
    std::uint8_t divisions = 1;
    std::vector<float> mean, variance;
    int hits = 0;
    bool operator==(const Face&) const = default;
  };
  using Ids = std::array<std::uint32_t, 3>;
  std::map<Ids, Face> faces;                         // by vertex ids in winding order, as added
  std::map<std::uint32_t, std::array<float, 3>> at;  // positions of vertices that faces use
  bool operator==(const NaiveMesh&) const = default;

  void remove(const Ids& ids) {
    faces.erase(ids);
    std::map<std::uint32_t, std::array<float, 3>> used;
    for (const auto& [face, data] : faces)
      for (auto id : face) used[id] = at.at(id);
    at = std::move(used);
  }
  /// Directed edges whose reverse belongs to no face: where a new face may join.
  std::vector<std::array<std::uint32_t, 2>> open_edges() const {
    std::map<std::array<std::uint32_t, 2>, int> edges;
    for (const auto& [f, data] : faces)
      for (std::size_t k = 0; k < 3; ++k) edges[{f[k], f[(k + 1) % 3]}] = 1;
    std::vector<std::array<std::uint32_t, 2>> open;
    for (const auto& [edge, one] : edges)
      if (!edges.count({edge[1], edge[0]})) open.push_back(edge);
    return open;
  }
};

/// Reads a map into the simple form, and throws where copies of a vertex disagree.
inline NaiveMesh naive(const PpmMap& map) {
  NaiveMesh mesh;
  for (const auto& chunk : map.table().chunks()) {
    const Geometry& g = *chunk.geometry;
    const Texels& t = *chunk.texels;
    for (std::size_t v = 0; v < g.position.size(); ++v) {
      const std::array<float, 3> p{g.position[v].x(), g.position[v].y(), g.position[v].z()};
      PPM_CHECK(mesh.at.emplace(g.vertex_id[v], p).first->second == p, "vertex {} is in two places", g.vertex_id[v]);
    }
    for (std::size_t f = 0; f < g.face.size(); ++f) {
      const auto& c = g.face[f];
      const auto begin = static_cast<std::ptrdiff_t>(g.first_texel[f]), end = begin + texel_count(g.divisions[f]);
      mesh.faces[{g.vertex_id[c[0]], g.vertex_id[c[1]], g.vertex_id[c[2]]}] = {
          g.divisions[f],
          {t.mean.begin() + begin, t.mean.begin() + end},
          {t.variance.begin() + begin, t.variance.begin() + end},
          t.evidence[f].hits};
    }
  }
  return mesh;
}

}  // namespace ppm::test
