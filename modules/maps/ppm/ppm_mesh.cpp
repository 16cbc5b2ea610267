#include <array>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {
namespace {

/// Information-weighted mean of texels, and their typical variance.
struct Fusion {
  double information = 0, weighted = 0, count = 0;
  void add(float mean, float variance) {
    information += 1.0 / variance;
    weighted += mean / static_cast<double>(variance);
    count += 1;
  }
  void add(const Fusion& other) {
    information += other.information;
    weighted += other.weighted;
    count += other.count;
  }
  double mean() const { return weighted / information; }
  /// Harmonic: texels that meet in a point are one place measured once, not so many independent measurements.
  double variance() const { return count / information; }
};

/// Collects what the texels say about each vertex of the mesh.
class VertexOffsets {
 public:
  VertexOffsets(std::size_t vertices, double prior_sigma_m)
      : corner_(vertices), around_(vertices), prior_variance_(prior_sigma_m * prior_sigma_m) {}

  void add_chunk(const PpmChunk& chunk, const std::vector<std::uint32_t>& number) {
    const Geometry& geometry = *chunk.geometry;
    const Texels& texels = *chunk.texels;
    for (std::size_t f = 0; f < geometry.face.size(); ++f) {
      const std::uint32_t first = geometry.first_texel[f], n = geometry.divisions[f];
      Fusion all;
      for (std::uint32_t t = first; t < first + texel_count(n); ++t) all.add(texels.mean[t], texels.variance[t]);
      const std::array<std::uint32_t, 3> corner{texel_index(n, 0, 0), texel_index(n, n, 0), texel_index(n, 0, n)};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = number[geometry.vertex_id[geometry.face[f][k]]];
        corner_[v].add(texels.mean[first + corner[k]], texels.variance[first + corner[k]]);
        around_[v].add(all);
      }
    }
  }

  /// Where a vertex's own texels were never observed, its faces speak for it: else it would stand out as a spike.
  const Fusion& at(std::size_t v) const {
    return corner_[v].variance() < 0.9 * prior_variance_ ? corner_[v] : around_[v];
  }

 private:
  std::vector<Fusion> corner_, around_;
  double prior_variance_;
};

/// Area-weighted normals of a mesh whose vertices have moved.
void recompute_normals(Mesh& mesh) {
  std::vector<Eigen::Vector3f> sum(mesh.position.size(), Eigen::Vector3f::Zero());
  for (const auto& face : mesh.face) {
    const auto& p = mesh.position;
    const Eigen::Vector3f cross = (p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]);
    for (auto v : face) sum[v] += cross;
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (!sum[v].isZero(0)) mesh.normal[v] = sum[v].normalized();
}

}  // namespace

Mesh PpmMap::mesh(Surface surface) const {
  Mesh mesh;
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> number(next_vertex_id_, kUnused);  // by vertex id
  for (const auto& chunk : table_.chunks())
    for (std::size_t v = 0; v < chunk.geometry->position.size(); ++v) {
      auto& n = number[chunk.geometry->vertex_id[v]];
      if (n != kUnused) continue;
      n = static_cast<std::uint32_t>(mesh.position.size());
      mesh.position.push_back(chunk.geometry->position[v]);
      mesh.normal.push_back(chunk.geometry->normal[v]);
    }
  VertexOffsets offsets(mesh.position.size(), settings_.prior_sigma_m);
  for (const auto& chunk : table_.chunks()) {
    offsets.add_chunk(chunk, number);
    const Geometry& geometry = *chunk.geometry;
    for (const auto& [a, b, c] : geometry.face)
      mesh.face.push_back(
          {number[geometry.vertex_id[a]], number[geometry.vertex_id[b]], number[geometry.vertex_id[c]]});
  }
  mesh.mean.resize(mesh.position.size());
  mesh.variance.resize(mesh.position.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    mesh.mean[v] = static_cast<float>(offsets.at(v).mean());
    mesh.variance[v] = static_cast<float>(offsets.at(v).variance());
    if (surface == Surface::displaced) mesh.position[v] += mesh.mean[v] * mesh.normal[v];
  }
  if (surface == Surface::displaced) recompute_normals(mesh);
  return mesh;
}

}  // namespace ppm
