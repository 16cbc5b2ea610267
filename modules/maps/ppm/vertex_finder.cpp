#include "modules/maps/ppm/vertex_finder.hpp"

#include <algorithm>
#include <cmath>

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
  auto& chunks = it->second;
  const auto& table = map_.table();
  const int r = map_.reach();
  if (std::pow(2.0 * r + 1, 3) > static_cast<double>(table.size())) {
    for (std::uint32_t chunk = 0; chunk < table.size(); ++chunk)
      if ((table.cell(chunk) - cell).cwiseAbs().maxCoeff() <= r) chunks.push_back(chunk);
    return chunks;
  }
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z)
        if (const auto chunk = table.find(cell + Cell(x, y, z)); chunk != ChunkTable<PpmChunk>::kNone)
          chunks.push_back(chunk);
  std::sort(chunks.begin(), chunks.end());
  return chunks;
}

}  // namespace ppm
