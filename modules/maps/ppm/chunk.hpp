#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "framework/core/cow.hpp"
#include "modules/maps/ppm/texel_grid.hpp"

namespace ppm {

/// The shape of a chunk. Faces wind counter-clockwise seen from the side that was observed, so that the face normal
/// (p1-p0) x (p2-p0) points into free space. A texel mean is measured along it, positive into free space.
/// Source: paper, section 3, M = (V, F, T), cut into spatial cells.
struct Geometry {
  /// Unique for each content that ever existed in this process: key of caches; neither saved nor hashed.
  std::uint64_t id = 0;
  std::vector<Eigen::Vector3f> position;  ///< [V] m, map frame
  std::vector<Eigen::Vector3f> normal;    ///< [V] unit, area-weighted over all incident faces of all chunks
  /// [V] ascending; the map's number of the vertex, the same in every chunk that uses it.
  std::vector<std::uint32_t> vertex_id;
  std::vector<std::array<std::uint32_t, 3>> face;  ///< [F] indices into position
  std::vector<std::uint8_t> divisions;             ///< [F] n >= 1: each edge is divided into n; texel_count(n) texels
  /// [F] index of the face's first texel in Texels; faces follow each other without gaps.
  std::vector<std::uint32_t> first_texel;
  /// Ascending; directed edges (vertex ids, in winding order) without a partner in this chunk.
  std::vector<std::array<std::uint32_t, 2>> open_edge;
  Eigen::AlignedBox3f box;  ///< of position

  Eigen::Vector3f face_normal(std::size_t f) const;              ///< unit
  Eigen::Vector3f point(std::size_t f, float u, float v) const;  ///< (1-u-v) p0 + u p1 + v p2
  /// Index of the vertex with that vertex_id, or kNoVertex. Binary search.
  std::uint32_t find_vertex(std::uint32_t vertex) const;
  static constexpr std::uint32_t kNoVertex = 0xffffffffu;
  /// Gives back memory that was reserved: what a chunk occupies depends on its content alone, not on its history.
  void shrink_to_fit();
  std::int64_t bytes() const;
};
/// An id that no geometry of this process has had. Results must not depend on its value.
std::uint64_t next_geometry_id();

/// Evidence about a face, for its life as a whole (saturating).
struct FaceEvidence {
  std::uint16_t hits = 0;     ///< pixels that measured this face
  std::uint16_t through = 0;  ///< pixels that measured something behind it
  /// m^2 along the normal: how much more the face's measurements scatter about what was predicted than texels and
  /// sensor account for (poses, shape below a texel). A running mean, signed; see added_variance().
  float excess = 0;
  /// What excess adds to the variance of the described surface, m^2.
  float added_variance() const { return std::max(excess, 0.0f); }
};

/// Texels side by side, read only: of one face in the order of texel_index, or of a chunk.
struct TexelView {
  std::span<const float> mean, variance;
  std::span<const float> color = {}, color_variance = {};
};

/// Values of texels. Colour is there in maps with colour channels, empty in others.
struct TexelArrays {
  std::vector<float> mean;            ///< [T] m along the face normal
  std::vector<float> variance;        ///< [T] m^2; the prior's where never observed
  std::vector<float> color;           ///< [T*C] interleaved: intensity or R, G, B as the camera encodes them, 0 .. 1
  std::vector<float> color_variance;  ///< [T] of each channel alike: all are seen at once, by like sensors

  std::size_t size() const { return mean.size(); }
  std::size_t channels() const { return mean.empty() ? 0 : color.size() / mean.size(); }
  TexelView view(std::size_t first, std::size_t count) const;
  void append(const TexelView& texels);
  /// Texels from, from + 1, .. become to, to + 1, ..; to <= from.
  void move_down(std::size_t from, std::size_t to, std::size_t count);
  /// Drops the texels from `count` on.
  void truncate(std::size_t count);
};

/// The texture of a chunk: texels lie on a triangular grid over each face, corners and edges included.
struct Texels : TexelArrays {
  std::vector<FaceEvidence> evidence;  ///< [F]
  /// [F] 1: the face took part in a simplification, or came out of one; 0: it is to take part when it is mature.
  std::vector<std::uint8_t> settled;
  void shrink_to_fit();  ///< see Geometry
  std::int64_t bytes() const;
};

struct PpmChunk {
  Cow<Geometry> geometry;
  Cow<Texels> texels;
};

}  // namespace ppm
