#include "modules/simplify/region.hpp"

#include <algorithm>

namespace ppm {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

bool takes_part(const FaceEvidence& evidence, const DueSettings& settings) {
  return evidence.hits >= settings.hits_least;
}

/// Locks what the region shares with other faces, and lists their edges between vertices of the region.
void lock_shared(const PpmMap& map, const std::vector<std::uint32_t>& number, Region& region) {
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& geometry = *map.table()[c].geometry;
    auto own = std::lower_bound(region.face.begin(), region.face.end(), FaceRef{c, 0});
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
      if (own != region.face.end() && *own == FaceRef{c, f}) {
        ++own;
        continue;
      }
      Triangle v;
      for (std::size_t k = 0; k < 3; ++k) v[k] = number[geometry.vertex_id[geometry.face[f][k]]];
      for (std::size_t k = 0; k < 3; ++k) {
        if (v[k] == kNone) continue;
        region.locked[v[k]] = 1;
        if (v[(k + 1) % 3] != kNone) region.outer.push_back({v[k], v[(k + 1) % 3]});
      }
    }
  }
  std::sort(region.outer.begin(), region.outer.end());
}

/// Locks vertices from which two borders start: there is no telling which of them an edge would shorten.
void lock_bow_ties(Region& region) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& t : region.corner)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  std::uint32_t last = kNone;
  for (const auto& [a, b] : edges) {
    if (std::binary_search(edges.begin(), edges.end(), std::array{b, a})) continue;
    if (a == last) region.locked[a] = 1;
    last = a;
  }
}

/// Moves each vertex along its normal by the mean of its texels, weighted by their information.
void displace(const PpmMap& map, Region& region) {
  std::vector<float> sum(region.id.size(), 0.0f), weight(region.id.size(), 0.0f);
  std::vector<Eigen::Vector3f> normal(region.id.size());
  for (std::size_t f = 0; f < region.face.size(); ++f) {
    const TexturedFace& face = region.textured[f];
    const Geometry& geometry = *map.table()[region.face[f].chunk].geometry;
    const std::uint32_t n = face.divisions, texel[3] = {0, texel_index(n, n, 0), texel_index(n, 0, n)};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = region.corner[f][k];
      const float information = 1 / face.texels.variance[texel[k]];
      sum[v] += information * face.texels.mean[texel[k]];
      weight[v] += information;
      normal[v] = geometry.normal[geometry.face[region.face[f].face][k]];
    }
  }
  for (std::size_t v = 0; v < region.id.size(); ++v)
    region.displaced.push_back(region.position[v] + sum[v] / weight[v] * normal[v]);
}

}  // namespace

std::vector<std::uint32_t> due_chunks(const PpmMap& map, const DueSettings& settings) {
  std::vector<std::uint32_t> due;
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Texels& texels = *map.table()[c].texels;
    std::size_t fresh = 0;
    for (std::size_t f = 0; f < texels.evidence.size(); ++f)
      fresh += !texels.settled[f] && takes_part(texels.evidence[f], settings);
    if (fresh > 0 && static_cast<float>(fresh) >= settings.share_least * static_cast<float>(texels.evidence.size()))
      due.push_back(c);
  }
  return due;
}

Region make_region(const PpmMap& map, const std::vector<std::uint32_t>& due, const DueSettings& settings) {
  Region region;
  std::vector<std::uint32_t> number(map.vertex_ids(), kNone);  // by vertex id
  for (auto c : due) {
    const Geometry& geometry = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
      if (!takes_part(map.table()[c].texels->evidence[f], settings)) continue;
      region.face.push_back({c, f});
      region.textured.push_back(textured_face(map.table()[c], f));
      for (auto v : geometry.face[f]) number[geometry.vertex_id[v]] = 0;
    }
  }
  for (std::uint32_t id = 0; id < number.size(); ++id)
    if (number[id] != kNone) {
      number[id] = static_cast<std::uint32_t>(region.id.size());
      region.id.push_back(id);
    }
  region.position.resize(region.id.size());
  region.locked.assign(region.id.size(), 0);
  for (const auto& [c, f] : region.face) {
    const Geometry& geometry = *map.table()[c].geometry;
    Triangle corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = geometry.face[f][k];
      corner[k] = number[geometry.vertex_id[v]];
      region.position[corner[k]] = geometry.position[v];
    }
    region.corner.push_back(corner);
  }
  displace(map, region);
  lock_shared(map, number, region);
  lock_bow_ties(region);
  return region;
}

}  // namespace ppm
