#include "modules/maps/ppm/chunk_edit.hpp"

#include <algorithm>
#include <numeric>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

Edge reversed(const Edge& e) {
  return {e[1], e[0]};
}
bool contains(const std::vector<Edge>& sorted, const Edge& e) {
  return std::binary_search(sorted.begin(), sorted.end(), e);
}

/// Removes the `dropped` edges from a sorted list and merges the `added` ones into it.
void replace_edges(std::vector<Edge>& open, std::vector<Edge> dropped, std::vector<Edge> added) {
  std::sort(dropped.begin(), dropped.end());
  std::sort(added.begin(), added.end());
  std::erase_if(open, [&](const Edge& e) { return contains(dropped, e); });
  const auto middle = static_cast<std::ptrdiff_t>(open.size());
  open.insert(open.end(), added.begin(), added.end());
  std::inplace_merge(open.begin(), open.begin() + middle, open.end());
}

void open_without(std::vector<Edge>& open, const std::vector<Edge>& removed) {
  std::vector<Edge> dropped, added;
  for (const auto& e : removed) {
    if (contains(open, e))
      dropped.push_back(e);
    else if (!contains(removed, reversed(e)))  // its partner stays, alone
      added.push_back(reversed(e));
  }
  replace_edges(open, std::move(dropped), std::move(added));
}

void open_with(std::vector<Edge>& open, const std::vector<Edge>& joined) {
  std::vector<Edge> dropped, added;
  for (const auto& e : joined) {
    if (contains(open, reversed(e)))
      dropped.push_back(reversed(e));
    else if (!contains(joined, reversed(e)))
      added.push_back(e);
  }
  replace_edges(open, std::move(dropped), std::move(added));
}

void renumber(Geometry& geometry, const std::vector<std::uint32_t>& number) {
  for (auto& face : geometry.face)
    for (auto& v : face) v = number[v];
}

}  // namespace

std::vector<Edge> sorted_edges(const Geometry& geometry, std::span<const std::uint32_t> faces) {
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (auto f : faces) {
    const auto& face = geometry.face[f];
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({geometry.vertex_id[face[k]], geometry.vertex_id[face[(k + 1) % 3]]});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<Edge> open_edges(const Geometry& geometry) {
  std::vector<std::uint32_t> all(geometry.face.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Edge> open;
  open_with(open, sorted_edges(geometry, all));
  return open;
}

void remove_faces(Geometry& geometry, Texels& texels, std::span<const std::uint32_t> faces) {
  if (faces.empty()) return;
  open_without(geometry.open_edge, sorted_edges(geometry, faces));
  std::size_t kept = faces.front();
  std::uint32_t texel = geometry.first_texel[kept];
  auto gone = faces.begin();
  for (std::size_t f = kept; f < geometry.face.size(); ++f) {
    if (gone != faces.end() && *gone == f) {
      ++gone;
      continue;
    }
    const std::uint32_t from = geometry.first_texel[f], count = texel_count(geometry.divisions[f]);
    texels.move_down(from, texel, count);
    texels.evidence[kept] = texels.evidence[f];
    texels.settled[kept] = texels.settled[f];
    geometry.face[kept] = geometry.face[f];
    geometry.divisions[kept] = geometry.divisions[f];
    geometry.first_texel[kept] = texel;
    texel += count;
    ++kept;
  }
  geometry.face.resize(kept);
  geometry.divisions.resize(kept);
  geometry.first_texel.resize(kept);
  texels.evidence.resize(kept);
  texels.settled.resize(kept);
  texels.truncate(texel);
}

void insert_vertices(Geometry& geometry, std::span<const NewVertex> vertices) {
  if (vertices.empty()) return;
  const std::size_t old_count = geometry.vertex_id.size(), count = old_count + vertices.size();
  std::vector<std::uint32_t> number(old_count);
  geometry.vertex_id.resize(count);
  geometry.position.resize(count);
  geometry.normal.resize(count);
  // Merge from the back, so that nothing is overwritten before it has moved.
  std::size_t old = old_count, fresh = vertices.size();
  for (std::size_t to = count; fresh > 0; --to) {
    if (old > 0 && geometry.vertex_id[old - 1] > vertices[fresh - 1].id) {
      --old;
      geometry.vertex_id[to - 1] = geometry.vertex_id[old];
      geometry.position[to - 1] = geometry.position[old];
      geometry.normal[to - 1] = geometry.normal[old];
      number[old] = static_cast<std::uint32_t>(to - 1);
    } else {
      --fresh;
      geometry.vertex_id[to - 1] = vertices[fresh].id;
      geometry.position[to - 1] = vertices[fresh].position;
      geometry.normal[to - 1].setZero();
    }
  }
  if (old == old_count) return;  // all came last: nothing was renumbered
  std::iota(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(old), 0u);
  renumber(geometry, number);
}

void append_faces(Geometry& geometry, Texels& texels, std::span<const NewFace> faces) {
  std::vector<std::uint32_t> added;
  for (const auto& f : faces) {
    std::array<std::uint32_t, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = geometry.find_vertex(f.id[k]);
      PPM_CHECK(corner[k] != Geometry::kNoVertex, "vertex {} is not in the chunk", f.id[k]);
    }
    added.push_back(static_cast<std::uint32_t>(geometry.face.size()));
    geometry.face.push_back(corner);
    geometry.divisions.push_back(f.divisions);
    geometry.first_texel.push_back(static_cast<std::uint32_t>(texels.size()));
    texels.append(f.texels);
    texels.evidence.push_back(f.evidence);
    texels.settled.push_back(f.settled);
  }
  open_with(geometry.open_edge, sorted_edges(geometry, added));
}

void drop_unused_vertices(Geometry& geometry) {
  const std::size_t count = geometry.vertex_id.size();
  std::vector<std::uint32_t> number(count, 0);
  for (const auto& face : geometry.face)
    for (auto v : face) number[v] = 1;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < count; ++v) {
    if (number[v] == 0) continue;
    geometry.vertex_id[kept] = geometry.vertex_id[v];
    geometry.position[kept] = geometry.position[v];
    geometry.normal[kept] = geometry.normal[v];
    number[v] = kept++;
  }
  if (kept == count) return;
  geometry.vertex_id.resize(kept);
  geometry.position.resize(kept);
  geometry.normal.resize(kept);
  renumber(geometry, number);
}

Eigen::AlignedBox3f bounding_box(const Geometry& geometry) {
  Eigen::AlignedBox3f box;
  for (const auto& p : geometry.position) box.extend(p);
  return box;
}

}  // namespace ppm
