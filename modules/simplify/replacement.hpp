#pragma once
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modules/maps/ppm/texel_resample.hpp"
#include "modules/simplify/region.hpp"

namespace ppm {

/// What a face that replaces others must keep to.
struct ReplacementSettings {
  ResampleTolerance tolerance{0.004f, 0.5f};  ///< between the surfaces that old and new faces describe
  float offset_most = 0.04f;               ///< m, between the new face and the surface that it describes
  float border = 0.01f;                    ///< m, that open borders may move
  float shape_least = 0.05f;               ///< of a face: 4 sqrt(3) area / sum of squared edges; 1 = equilateral
};

/// Judges triangles over a region's vertices that are to stand in place of its faces: each is given the texels that it
/// would have, and compared with the surface described so far. Remembers the triangles that it has seen.
class Replacement {
 public:
  Replacement(const Region& region, const PpmSettings& map, const ReplacementSettings& settings);

  /// The region's faces that have to stay because a triangle in their place does not do: it describes another surface,
  /// is a sliver, moves a border, or has an edge that a face on the same side has too. Ascending; empty when all is
  /// well. `proposed` stands in place of the faces with stays[f] = 0.
  std::vector<std::uint32_t> faults(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays);

  /// Faces, and all that have a vertex in common with one of them.
  std::vector<std::uint32_t> with_neighbours(const std::vector<std::uint32_t>& faces) const;

  /// Of a proposal without faults: the triangles that are no faces yet, with texels and evidence; and by face of the
  /// region whether it goes.
  struct Result {
    std::vector<Triangle> triangle;
    std::vector<ResampledFace> face;
    std::vector<std::uint8_t> goes;
  };
  Result take(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays);

 private:
  struct Judged {
    ResampledFace face;
    bool sound = false;
  };
  struct BorderEdge {
    std::uint32_t from, to, face;
  };
  struct TriangleHash {
    std::size_t operator()(const Triangle& t) const {
      return (std::size_t{t[0]} * 0x9E3779B97F4A7C15ull) ^ (std::size_t{t[1]} * 0xC2B2AE3D27D4EB4Full) ^
             (std::size_t{t[2]} * 0x165667B19E3779F9ull);
    }
  };
  const Judged& judge(const Triangle& triangle);
  using Edges = std::vector<std::array<std::uint32_t, 2>>;
  Edges edges_of(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays) const;
  void find_double_edges(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays,
                         const Edges& edges, std::vector<std::uint32_t>& faults);
  void find_moved_borders(const std::vector<std::uint8_t>& stays, const Edges& edges,
                          std::vector<std::uint32_t>& faults) const;
  void blame(const Triangle& triangle, const std::vector<std::uint8_t>& stays, std::vector<std::uint32_t>& faults);
  void blame_vertex(std::uint32_t vertex, const std::vector<std::uint8_t>& stays,
                    std::vector<std::uint32_t>& faults) const;
  bool follow(std::size_t edge, std::uint32_t to, std::vector<std::size_t>& passed, float& strays) const;
  std::size_t first_border_from(std::uint32_t vertex) const;

  const Region& region_;
  ReplacementSettings settings_;
  TexelResampler resampler_;
  // By vertices from the lowest on. Neither is iterated over.
  std::unordered_map<Triangle, std::uint32_t, TriangleHash> old_;  // faces of the region
  std::unordered_map<Triangle, Judged, TriangleHash> judged_;
  std::vector<BorderEdge> border_;           // the region's part of the map's border, ascending
  std::vector<std::uint32_t> first_around_;  // [V+1] by vertex: where its faces begin in around_
  std::vector<std::uint32_t> around_;        // faces of the region
};

}  // namespace ppm
