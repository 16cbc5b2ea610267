#include "modules/maps/ppm/face_neighbours.hpp"

#include <algorithm>

namespace ppm {

Edge FaceNeighbours::edge(const FaceSide& side) const {
  const Geometry& geometry = *map_.table()[side.face.chunk].geometry;
  const auto& face = geometry.face[side.face.face];
  return {geometry.vertex_id[face[side.k]], geometry.vertex_id[face[(side.k + 1) % 3]]};
}

std::optional<FaceSide> FaceNeighbours::across(const FaceSide& side) {
  const Edge here = edge(side), there{here[1], here[0]};
  const auto own = side.face.chunk;
  if (const auto found = find(own, there)) return found;
  const Geometry& geometry = *map_.table()[own].geometry;
  const Eigen::Vector3f position = geometry.position[geometry.face[side.face.face][side.k]];
  for (const auto& copy : finder_.copies(here[0], position))
    if (copy.chunk != own)
      if (const auto found = find(copy.chunk, there)) return found;
  return {};
}

const std::vector<FaceNeighbours::Entry>& FaceNeighbours::table(std::uint32_t chunk) {
  auto [it, is_new] = tables_.try_emplace(chunk);
  auto& entries = it->second;
  if (!is_new) return entries;
  const Geometry& geometry = *map_.table()[chunk].geometry;
  entries.reserve(3 * geometry.face.size());
  for (std::uint32_t f = 0; f < geometry.face.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k) entries.push_back({edge({{chunk, f}, k}), f, k});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.edge < b.edge; });
  return entries;
}

std::optional<FaceSide> FaceNeighbours::find(std::uint32_t chunk, const Edge& edge) {
  const auto& entries = table(chunk);
  const auto it = std::lower_bound(entries.begin(), entries.end(), edge,
                                   [](const Entry& e, const Edge& wanted) { return e.edge < wanted; });
  if (it == entries.end() || it->edge != edge) return {};
  return FaceSide{{chunk, it->face}, it->k};
}

}  // namespace ppm
