#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/vertex_normals.hpp"

namespace ppm {
namespace {

void check_faces(std::size_t chunk, const Geometry& geometry, const PpmSettings& settings) {
  const std::size_t vertices = geometry.position.size(), faces = geometry.face.size();
  PPM_CHECK(geometry.divisions.size() == faces && geometry.first_texel.size() == faces,
            "chunk {}: counts of faces differ", chunk);
  std::vector<bool> used(vertices, false);
  std::uint32_t texels = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto& [a, b, c] = geometry.face[f];
    PPM_CHECK(std::max({a, b, c}) < vertices, "chunk {} face {}: no such vertex", chunk, f);
    const Eigen::Vector3f u = geometry.position[b] - geometry.position[a],
                          v = geometry.position[c] - geometry.position[a];
    const double area = u.cast<double>().cross(v.cast<double>()).norm();
    PPM_CHECK(std::isfinite(area) && area > 0, "chunk {} face {}: degenerate", chunk, f);
    used[a] = used[b] = used[c] = true;
    PPM_CHECK(geometry.divisions[f] >= 1 && geometry.divisions[f] <= settings.max_divisions,
              "chunk {} face {}: {} divisions", chunk, f, geometry.divisions[f]);
    PPM_CHECK(geometry.first_texel[f] == texels, "chunk {} face {}: texels are not in the order of faces", chunk, f);
    texels += texel_count(geometry.divisions[f]);
  }
  PPM_CHECK(std::find(used.begin(), used.end(), false) == used.end(), "chunk {}: a vertex without a face", chunk);
}

void check_vertices(std::size_t chunk, const Geometry& geometry, std::uint32_t vertex_ids) {
  const std::size_t vertices = geometry.position.size();
  PPM_CHECK(geometry.normal.size() == vertices && geometry.vertex_id.size() == vertices,
            "chunk {}: counts of vertices differ", chunk);
  for (std::size_t v = 0; v < vertices; ++v) {
    PPM_CHECK(geometry.position[v].allFinite(), "chunk {} vertex {}: not finite", chunk, v);
    PPM_CHECK(geometry.vertex_id[v] < vertex_ids, "chunk {} vertex {}: id never handed out", chunk, v);
    PPM_CHECK(v == 0 || geometry.vertex_id[v - 1] < geometry.vertex_id[v], "chunk {}: vertex ids do not ascend", chunk);
  }
}

void check_texels(std::size_t chunk, const Geometry& geometry, const Texels& texels, std::size_t channels) {
  std::size_t count = 0;
  for (auto n : geometry.divisions) count += texel_count(n);
  PPM_CHECK(
      texels.mean.size() == count && texels.variance.size() == count && texels.evidence.size() == geometry.face.size() &&
          texels.settled.size() == geometry.face.size(),
      "chunk {}: texels do not fit its faces", chunk);
  PPM_CHECK(texels.color.size() == channels * count && texels.color_variance.size() == (channels > 0 ? count : 0),
            "chunk {}: colours do not fit its texels", chunk);
  for (float c : texels.color) PPM_CHECK(std::isfinite(c), "chunk {}: a colour is not finite", chunk);
  for (float v : texels.color_variance)
    PPM_CHECK(std::isfinite(v) && v > 0, "chunk {}: the variance of a colour is {}", chunk, v);
  for (const auto& e : texels.evidence)
    PPM_CHECK(std::isfinite(e.excess), "chunk {}: the excess variance of a face is {}", chunk, e.excess);
  for (std::size_t t = 0; t < count; ++t)
    PPM_CHECK(std::isfinite(texels.mean[t]) && std::isfinite(texels.variance[t]) && texels.variance[t] > 0,
              "chunk {} texel {}: mean {} variance {}", chunk, t, texels.mean[t], texels.variance[t]);
}

void check_derived(std::size_t chunk, const Geometry& geometry, const Cell& cell, const PpmMap& map) {
  PPM_CHECK(geometry.open_edge == open_edges(geometry), "chunk {}: open edges are stale", chunk);
  const auto box = bounding_box(geometry);
  PPM_CHECK(box.min() == geometry.box.min() && box.max() == geometry.box.max(), "chunk {}: box is stale", chunk);
  if (box.isEmpty()) return;
  for (const auto& corner : {box.min(), box.max()})
    PPM_CHECK((map.cell_of(corner) - cell).cwiseAbs().maxCoeff() <= map.reach(), "chunk {}: reaches too far", chunk);
}

/// An edge has at most two faces, wound oppositely: no directed edge occurs twice.
void check_edges(const PpmMap& map) {
  std::vector<Edge> edges;
  for (const auto& chunk : map.table().chunks())
    for (const auto& face : chunk.geometry->face)
      for (std::size_t k = 0; k < 3; ++k)
        edges.push_back({chunk.geometry->vertex_id[face[k]], chunk.geometry->vertex_id[face[(k + 1) % 3]]});
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end())
    PPM_CHECK(false, "the edge {} -> {} has two faces on the same side", (*twice)[0], (*twice)[1]);
}

void check_copies(const PpmMap& map) {
  struct Copy {
    NewVertex vertex;
    VertexCopy copy;
  };
  std::vector<Copy> copies;
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& geometry = *map.table()[c].geometry;
    for (std::uint32_t v = 0; v < geometry.position.size(); ++v)
      copies.push_back({{geometry.vertex_id[v], geometry.position[v]}, {c, v}});
  }
  std::stable_sort(copies.begin(), copies.end(),
                   [](const auto& a, const auto& b) { return a.vertex.id < b.vertex.id; });
  std::vector<NewVertex> vertices;
  for (const auto& [vertex, copy] : copies) {
    if (vertices.empty() || vertices.back().id != vertex.id) vertices.push_back(vertex);
    PPM_CHECK(vertices.back().position == vertex.position, "copies of vertex {} are apart", vertex.id);
  }
  const auto normals = vertex_normals(map, vertices);
  PPM_CHECK(normals.size() == copies.size(), "{} of {} vertex copies can be found", normals.size(), copies.size());
  for (const auto& [copy, normal] : normals)
    PPM_CHECK(map.table()[copy.chunk].geometry->normal[copy.vertex] == normal, "chunk {} vertex {}: normal is stale",
              copy.chunk, copy.vertex);
}

}  // namespace

void PpmMap::check() const {
  for (std::size_t c = 0; c < table_.size(); ++c) {
    const Geometry& geometry = *table_[c].geometry;
    check_vertices(c, geometry, next_vertex_id_);
    check_faces(c, geometry, settings_);
    check_texels(c, geometry, *table_[c].texels, static_cast<std::size_t>(settings_.color_channels));
    check_derived(c, geometry, table_.cell(c), *this);
  }
  check_edges(*this);
  check_copies(*this);
}

}  // namespace ppm
