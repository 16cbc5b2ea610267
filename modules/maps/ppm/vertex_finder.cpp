#include "modules/maps/ppm/vertex_finder.hpp"

#include <algorithm>

namespace ppm {

const std::vector<VertexCopy>& VertexFinder::copies(std::uint32_t id, const Eigen::Vector3f& position) {
  found_.clear();
  for (auto chunk : candidates(map_.cell_of(position))) {
    const Geometry& geometry = *map_.table()[chunk].geometry;
    if (!geometry.box.contains(position)) continue;
    const auto vertex = geometry.find_vertex(id);
    if (vertex != Geometry::kNoVertex) found_.push_back({chunk, vertex});
  }
  return found_;
}

const std::vector<std::uint32_t>& VertexFinder::candidates(const Cell& cell) {
  auto [it, is_new] = near_.try_emplace(cell);
  if (!is_new) return it->second;
  const int r = map_.reach();
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z) {
        const auto chunk = map_.table().find(cell + Cell(x, y, z));
        if (chunk != ChunkTable<PpmChunk>::kNone) it->second.push_back(chunk);
      }
  std::sort(it->second.begin(), it->second.end());
  return it->second;
}

}  // namespace ppm
