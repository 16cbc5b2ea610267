#include "modules/maps/ppm/dense_mesh.hpp"

#include "modules/maps/ppm/face_texels.hpp"
#include "modules/maps/ppm/face_tiling.hpp"
#include "modules/maps/ppm/welding.hpp"

namespace ppm {
namespace {

/// Calls f(number of the face in the whole mesh, chunk, its number in the chunk).
template <class F>
void for_each_face(const PpmMap& map, F f) {
  std::uint32_t number = 0;
  for (const auto& chunk : map.table().chunks())
    for (std::uint32_t face = 0; face < chunk.geometry->face.size(); ++face) f(number++, chunk, face);
}

/// Gives the vertices from `first` on what their texels say.
void write(const std::vector<MeshNode>& nodes, std::size_t first, bool colored, Mesh& mesh) {
  const std::size_t last = first + nodes.size();
  mesh.mean.resize(last);
  mesh.variance.resize(last);
  if (colored) mesh.color.resize(last);
  for (std::size_t v = first; v < last; ++v) {
    const MeshNode& node = nodes[v - first];
    mesh.mean[v] = node.offset.offset();
    mesh.variance[v] = node.offset.variance();
    if (colored) mesh.color[v] = node.color.color();
  }
}

/// Area-weighted normals of a mesh whose vertices have moved.
void recompute_normals(Mesh& mesh) {
  std::vector<Eigen::Vector3f> sum(mesh.position.size(), Eigen::Vector3f::Zero());
  for (const auto& face : mesh.face) {
    const auto& p = mesh.position;
    const Eigen::Vector3f cross = (p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]);
    for (auto v : face) sum[v] += cross;
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (sum[v].squaredNorm() > 0) mesh.normal[v] = sum[v].normalized();
}

/// Vertices first, then the nodes on edges, then those inside faces.
class DenseMesh {
 public:
  explicit DenseMesh(const PpmMap& map) : map_(map), welding_(weld(map, WeldEdges::yes)) {
    mesh_.position = welding_.position;
    mesh_.normal = welding_.normal;
    first_on_edge_.reserve(welding_.edge.size());
    for (const auto& edge : welding_.edge) {
      first_on_edge_.push_back(nodes());
      const auto [a, b] = edge.vertex;
      for (std::uint32_t s = 1; s < edge.divisions; ++s) {
        const float w = static_cast<float>(s) / static_cast<float>(edge.divisions);
        add_node({a, b, b}, w, 0);
      }
    }
    shared_.resize(nodes());
  }

  Mesh build() {
    for_each_face(map_, [this](auto number, const auto& chunk, auto face) {
      take_sides(number, chunk, face);
      take_inside(number, chunk, face);
    });
    const bool colored = map_.settings().color_channels > 0;
    write(shared_, 0, colored, mesh_);
    write(inside_, shared_.size(), colored, mesh_);
    for (std::size_t v = 0; v < nodes(); ++v) mesh_.position[v] += mesh_.mean[v] * mesh_.normal[v];
    recompute_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  std::uint32_t nodes() const { return static_cast<std::uint32_t>(mesh_.position.size()); }

  void add_node(const std::array<std::uint32_t, 3>& corner, float u, float v) {
    const auto &p = welding_.position, &n = welding_.normal;
    const auto [a, b, c] = corner;
    const float w = 1 - u - v;
    mesh_.position.push_back(w * p[a] + u * p[b] + v * p[c]);
    const Eigen::Vector3f sum = w * n[a] + u * n[b] + v * n[c];
    mesh_.normal.push_back(sum.squaredNorm() > 1e-6f ? Eigen::Vector3f(sum.normalized()) : n[a]);
  }

  /// Nodes of side k of a face, in its direction, both corners included.
  std::vector<std::uint32_t> side(std::uint32_t number, std::uint32_t k) const {
    const auto e = welding_.edges[number][k];
    const auto& edge = welding_.edge[e];
    const auto from = welding_.face[number][k];
    std::vector<std::uint32_t> line{edge.vertex[0]};
    for (std::uint32_t s = 1; s < edge.divisions; ++s) line.push_back(first_on_edge_[e] + s - 1);
    line.push_back(edge.vertex[1]);
    if (from != edge.vertex[0]) std::reverse(line.begin(), line.end());
    return line;
  }

  void take_sides(std::uint32_t number, const PpmChunk& chunk, std::uint32_t face) {
    const FaceTexels texels(chunk, face);
    nodes_.divisions = chunk.geometry->divisions[face];
    for (std::uint32_t k = 0; k < 3; ++k) {
      nodes_.side[k] = side(number, k);
      const auto steps = nodes_.side[k].size() - 1;
      for (std::size_t s = 0; s < steps; ++s) {  // the last is the next side's first
        const auto node = nodes_.side[k][s];
        texels.add_on_side(k, static_cast<double>(s) / static_cast<double>(steps), mesh_.normal[node], shared_[node]);
      }
    }
  }

  void take_inside(std::uint32_t number, const PpmChunk& chunk, std::uint32_t face) {
    const FaceTexels texels(chunk, face);
    const std::uint32_t n = nodes_.divisions;
    nodes_.first_inside = nodes();
    for (std::uint32_t i = 1; i + 1 < n; ++i)
      for (std::uint32_t j = 1; i + j < n; ++j) {
        add_node(welding_.face[number], static_cast<float>(i) / static_cast<float>(n),
                 static_cast<float>(j) / static_cast<float>(n));
        texels.add(i, j, mesh_.normal.back(), inside_.emplace_back());
      }
    tile_face(nodes_, mesh_.face);
  }

  const PpmMap& map_;
  Welding welding_;
  Mesh mesh_;
  std::vector<std::uint32_t> first_on_edge_;  // [E]
  std::vector<MeshNode> shared_, inside_;
  FaceNodes nodes_;  // of the face at hand
};

}  // namespace

Mesh base_mesh(const PpmMap& map) {
  Welding welding = weld(map, WeldEdges::no);
  std::vector<MeshNode> nodes(welding.position.size());
  for_each_face(map, [&](auto number, const auto& chunk, auto face) {
    const FaceTexels texels(chunk, face);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto v = welding.face[number][k];
      texels.add_on_side(k, 0, welding.normal[v], nodes[v]);
    }
  });
  Mesh mesh;
  mesh.position = std::move(welding.position);
  mesh.normal = std::move(welding.normal);
  mesh.face = std::move(welding.face);
  write(nodes, 0, map.settings().color_channels > 0, mesh);
  return mesh;
}

Mesh dense_mesh(const PpmMap& map) {
  return DenseMesh(map).build();
}

}  // namespace ppm
