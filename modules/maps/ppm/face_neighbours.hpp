#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/vertex_finder.hpp"

namespace ppm {

/// A side of a face: from its corner k to the next.
struct FaceSide {
  FaceRef face;
  std::uint32_t k = 0;
};

/// Finds the face beyond a side, across chunks too. Tables are made chunk by chunk as they are asked for. The map must
/// not change meanwhile.
class FaceNeighbours {
 public:
  explicit FaceNeighbours(const PpmMap& map) : map_(map), finder_(map) {}

  /// The face on the other side of the edge, and the edge as its side; nothing on the mesh's boundary.
  std::optional<FaceSide> across(const FaceSide& side);
  /// The edge's vertex ids, in the face's winding order.
  Edge edge(const FaceSide& side) const;

 private:
  struct Entry {
    Edge edge;
    std::uint32_t face, k;
  };
  const std::vector<Entry>& table(std::uint32_t chunk);
  std::optional<FaceSide> find(std::uint32_t chunk, const Edge& edge);

  const PpmMap& map_;
  VertexFinder finder_;
  std::map<std::uint32_t, std::vector<Entry>> tables_;  // by chunk; each by edge
};

}  // namespace ppm
