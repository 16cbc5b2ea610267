#include "modules/maps/ppm/boundary.hpp"

#include <algorithm>

#include "modules/maps/ppm/visible_chunks.hpp"

namespace ppm {

void Boundary::build(const PpmMap& map, const UpdateView& view, const std::vector<FaceRef>& removed) {
  for (const auto& v : vertex)
    if (v.id < number_of_id_.size()) number_of_id_[v.id] = kNone;
  number_of_id_.resize(map.vertex_ids(), kNone);
  vertex.clear();
  first_.clear();
  links_.clear();
  const auto chunks = chunks_in_image(map, view.camera, view.prediction->T_map_camera);
  for (auto c : chunks) read_open_edges(*map.table()[c].geometry, view);
  pair_chunk_borders();
  for (const auto& f : removed) take_away(*map.table()[f.chunk].geometry, f.face, view);
  for (auto c : chunks) read_shared_edges(*map.table()[c].geometry, c, removed);
}

/// The number of the vertex with that id, which the chunk has.
std::uint32_t Boundary::number_of(const Geometry& geometry, std::uint32_t id, const UpdateView& view) {
  auto& number = number_of_id_[id];
  if (number == kNone) {
    number = static_cast<std::uint32_t>(vertex.size());
    const auto local = geometry.find_vertex(id);
    const auto& position = geometry.position[local];
    vertex.push_back({id, position, view.relative(position), geometry.normal[local]});
    first_.push_back(kNone);
  }
  return number;
}

void Boundary::read_open_edges(const Geometry& geometry, const UpdateView& view) {
  for (const auto& [from, to] : geometry.open_edge)
    link(number_of(geometry, from, view), number_of(geometry, to, view), Kind::open);
}

void Boundary::pair_chunk_borders() {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t a = 0; a < first_.size(); ++a)
    for (auto l = first_[a]; l != kNone; l = links_[l].next)
      if (a < links_[l].to && is_open(links_[l].to, a)) pairs.push_back({a, links_[l].to});
  for (const auto& [a, b] : pairs) {
    unlink(a, b, Kind::open);
    unlink(b, a, Kind::open);
    share(a, b);
  }
}

void Boundary::take_away(const Geometry& geometry, std::uint32_t face, const UpdateView& view) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = number_of(geometry, geometry.vertex_id[geometry.face[face][k]], view);
    const auto b = number_of(geometry, geometry.vertex_id[geometry.face[face][(k + 1) % 3]], view);
    if (is_open(a, b)) {
      unlink(a, b, Kind::open);
      continue;
    }
    if (is_shared(a, b)) unlink(std::min(a, b), std::max(a, b), Kind::shared);
    link(b, a, Kind::open);
  }
}

void Boundary::read_shared_edges(const Geometry& geometry, std::uint32_t chunk, const std::vector<FaceRef>& removed) {
  local_.resize(geometry.vertex_id.size());
  for (std::size_t v = 0; v < local_.size(); ++v) local_[v] = number_of_id_[geometry.vertex_id[v]];
  for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
    const auto& [i, j, k] = geometry.face[f];
    const std::array<std::uint32_t, 3> n{local_[i], local_[j], local_[k]};
    if ((n[0] != kNone) + (n[1] != kNone) + (n[2] != kNone) < 2) continue;
    if (std::binary_search(removed.begin(), removed.end(), FaceRef{chunk, f})) continue;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto a = n[e], b = n[(e + 1) % 3];
      if (a != kNone && b != kNone && !is_open(a, b) && !is_shared(a, b)) share(a, b);
    }
  }
}

bool Boundary::is_rim(std::uint32_t a) const {
  for (auto l = first_[a]; l != kNone; l = links_[l].next)
    if (links_[l].kind == Kind::open) return true;
  return false;
}

bool Boundary::accepts(const std::array<std::uint32_t, 3>& face) const {
  return accepts_edge(face[0], face[1]) && accepts_edge(face[1], face[2]) && accepts_edge(face[2], face[0]);
}

void Boundary::add(const std::array<std::uint32_t, 3>& face) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = face[k], b = face[(k + 1) % 3];
    if (is_open(b, a)) {
      unlink(b, a, Kind::open);
      share(a, b);
    } else {
      link(a, b, Kind::open);
    }
  }
}

std::uint32_t Boundary::add_vertex(const UpdateView& view, const Eigen::Vector3f& point,
                                   const Eigen::Vector3f& normal) {
  vertex.push_back({RimVertex::kNew, view.absolute(point), point, normal});
  first_.push_back(kNone);
  return static_cast<std::uint32_t>(vertex.size() - 1);
}

void Boundary::open_from(std::uint32_t a, std::vector<std::uint32_t>& ends) const {
  ends.clear();
  for (auto l = first_[a]; l != kNone; l = links_[l].next)
    if (links_[l].kind == Kind::open) ends.push_back(links_[l].to);
}

std::uint32_t Boundary::find(std::uint32_t a, std::uint32_t b, Kind kind) const {
  for (auto l = first_[a]; l != kNone; l = links_[l].next)
    if (links_[l].to == b && links_[l].kind == kind) return l;
  return kNone;
}

void Boundary::link(std::uint32_t a, std::uint32_t b, Kind kind) {
  links_.push_back({b, first_[a], kind});
  first_[a] = static_cast<std::uint32_t>(links_.size() - 1);
}

void Boundary::unlink(std::uint32_t a, std::uint32_t b, Kind kind) {
  for (auto* l = &first_[a]; *l != kNone; l = &links_[*l].next)
    if (links_[*l].to == b && links_[*l].kind == kind) {
      *l = links_[*l].next;
      return;
    }
}

void Boundary::share(std::uint32_t a, std::uint32_t b) {
  link(std::min(a, b), std::max(a, b), Kind::shared);
}

}  // namespace ppm
