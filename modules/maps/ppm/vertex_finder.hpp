#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// One copy of a vertex: the chunk, and its index there.
struct VertexCopy {
  std::uint32_t chunk = 0;
  std::uint32_t vertex = 0;
  bool operator==(const VertexCopy&) const = default;
};

/// Finds the copies of vertices in the chunks of a map: the chunks near the vertex's cell are candidates, those whose
/// box holds it are searched. Remembers the candidates by cell, so ask one finder for many vertices. Chunks may change
/// while it is used, but none may be added.
class VertexFinder {
 public:
  explicit VertexFinder(const PpmMap& map) : map_(map) {}
  /// Every copy of a vertex, by ascending chunk; empty where there is none. Good until the next call.
  /// position: the vertex's, exactly.
  const std::vector<VertexCopy>& copies(std::uint32_t id, const Eigen::Vector3f& position);

 private:
  const std::vector<std::uint32_t>& candidates(const Cell& cell);
  const PpmMap& map_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> near_;
  std::vector<VertexCopy> found_;
};

}  // namespace ppm
