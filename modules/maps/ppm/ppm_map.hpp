#pragma once
#include <memory>

#include "framework/slam/chunk_table.hpp"
#include "framework/slam/map.hpp"
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// Fixed when a map is made.
struct PpmSettings {
  /// Edge of the cubic cell that holds a chunk; a face goes to the cell of its centroid and stays there.
  double cell_size_m = 1.0;
  double texel_size_m = 0.02;   ///< wanted distance between texels
  double prior_sigma_m = 0.05;  ///< standard deviation of an unobserved texel's offset
  int max_divisions = 64;
  int color_channels = 0;  ///< of the texture beside the offset: 0, 1 (intensity) or 3 (RGB)
};

/// A probabilistic polygonal mesh: triangles with, per texel, mean and variance of the surface's offset along the face
/// normal.
/// Invariants, see check(): the same vertex id has the same position and normal in every chunk; an edge has at most
/// two faces, wound oppositely; no degenerate face; texel and evidence counts fit; no vertex without a face; open edges
/// and boxes are up to date.
/// Source: paper, section 3.
class PpmMap final : public Map {
 public:
  /// An empty map. The settings must be positive, max_divisions at most 255, color_channels 0, 1 or 3
  /// (InternalError).
  explicit PpmMap(const PpmSettings& settings);
  std::string_view kind() const override { return "ppm"; }
  MapStats stats() const override;
  int color_channels() const override { return settings_.color_channels; }
  std::int64_t account(std::unordered_set<const void*>& seen) const override;
  void digest(Digest& digest) const override;
  /// Surface::displaced has a vertex for each texel, see dense_mesh().
  Mesh mesh(Surface surface) const override;

  const PpmSettings& settings() const { return settings_; }
  const ChunkTable<PpmChunk>& table() const { return table_; }
  std::uint32_t vertex_ids() const { return next_vertex_id_; }  ///< ids handed out so far
  Cell cell_of(const Eigen::Vector3f& p) const;
  /// Divisions for a face with these corners: the edge of the equilateral triangle of its area over the texel size,
  /// rounded up, 1 .. max_divisions. So a sliver gets the texels that its area deserves, wider apart along it than
  /// across.
  std::uint32_t divisions_for(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) const;
  /// By how many cells, at most, a chunk's faces reach out of its cell (an upper bound over the map's life).
  int reach() const { return reach_; }
  /// The same map, of which no memory is shared with any other but the index of its cells.
  std::shared_ptr<const PpmMap> unshared() const;
  /// Throws InternalError at the first broken invariant.
  void check() const;

 private:
  friend class PpmEdit;
  friend class PpmReader;
  friend class PpmCodec;
  PpmSettings settings_;
  ChunkTable<PpmChunk> table_;
  std::uint32_t next_vertex_id_ = 0;
  int reach_ = 0;
};

}  // namespace ppm
