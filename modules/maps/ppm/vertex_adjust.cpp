#include "modules/maps/ppm/vertex_adjust.hpp"

#include <algorithm>
#include <cmath>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/described_face.hpp"
#include "modules/maps/ppm/node_fusion.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "modules/maps/ppm/vertex_finder.hpp"

namespace ppm {
namespace {

/// What the texels around one vertex say, and the first of its copies.
struct AroundVertex {
  static constexpr std::uint32_t kUnused = 0xffffffffu;
  OffsetFusion weighted;
  double sum = 0;  // m, of the means
  std::uint32_t texels = 0;
  VertexCopy copy{kUnused, 0};
};

/// Calls f(position within the face's texels) for those up to `rings` steps from corner k.
template <class F>
void for_texels_around(std::uint32_t n, std::uint32_t k, std::uint32_t rings, F f) {
  const std::uint32_t r = std::min(rings, n);
  for (std::uint32_t away = 0; away <= r; ++away)
    for (std::uint32_t s = 0; s <= away; ++s)
      f(k == 0 ? texel_index(n, away - s, s) : k == 1 ? texel_index(n, n - away, s) : texel_index(n, s, n - away));
}

class Adjustment {
 public:
  Adjustment(const PpmMap& map, const AdjustSettings& settings) : map_(&map), settings_(settings) {}

  /// Finds the vertices that are to move; false where there are none.
  bool plan() {
    read_texels();
    step_.assign(around_.size(), 0);
    bool any = false;
    for (std::uint32_t id = 0; id < around_.size(); ++id) {
      step_[id] = wanted_step(around_[id]);
      any |= step_[id] != 0;
    }
    if (!any) return false;
    if (!settings_.boundary) hold_boundary();
    find_faces();
    while (hold_bad_faces()) {}
    return std::any_of(step_.begin(), step_.end(), [](float s) { return s != 0; });
  }

  /// edit: a session on the map; the plan's own may have gone to another owner by now.
  void write(PpmEdit& edit) {
    map_ = &edit.map();
    if (settings_.reexpress)
      for (const auto& f : faces_) reexpress(f, edit);
    for (std::uint32_t id = 0; id < step_.size(); ++id)
      if (step_[id] != 0) {
        const auto [chunk, vertex] = around_[id].copy;
        edit.move_vertex(chunk, vertex, place(*map_->table()[chunk].geometry, vertex));
      }
  }

  AdjustCounts counts() const {
    AdjustCounts counts{0, refused_, 0};
    for (float s : step_) {
      counts.moved += s != 0;
      counts.farthest = std::max(counts.farthest, std::abs(s));
    }
    return counts;
  }

 private:
  void read_texels() {
    around_.assign(map_->vertex_ids(), {});
    for (std::uint32_t c = 0; c < map_->table().size(); ++c) {
      const Geometry& geometry = *map_->table()[c].geometry;
      for (std::uint32_t f = 0; f < geometry.face.size(); ++f) read_face(c, f);
      for (std::uint32_t v = 0; v < geometry.vertex_id.size(); ++v)
        if (auto& copy = around_[geometry.vertex_id[v]].copy; copy.chunk == AroundVertex::kUnused) copy = {c, v};
    }
  }

  void read_face(std::uint32_t c, std::uint32_t f) {
    const Geometry& geometry = *map_->table()[c].geometry;
    const Texels& texels = *map_->table()[c].texels;
    const Eigen::Vector3f normal = geometry.face_normal(f);
    const auto rings = static_cast<std::uint32_t>(settings_.rings);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto v = geometry.face[f][k];
      AroundVertex& around = around_[geometry.vertex_id[v]];
      const float cosine = normal.dot(geometry.normal[v]);
      for_texels_around(geometry.divisions[f], k, rings, [&](std::uint32_t texel) {
        const auto t = geometry.first_texel[f] + texel;
        around.weighted.add(texels.mean[t], texels.variance[t], cosine);
        around.sum += texels.mean[t];
        ++around.texels;
      });
    }
  }

  /// m along the vertex's normal; 0 where it stays.
  float wanted_step(const AroundVertex& around) const {
    if (around.texels == 0) return 0;  // a vertex that has gone
    const float offset = settings_.weighted ? around.weighted.offset() : static_cast<float>(around.sum / around.texels);
    const float sigma = std::sqrt(around.weighted.variance());
    if (std::abs(offset) <= std::max(settings_.least, settings_.sigmas * sigma)) return 0;
    return std::clamp(offset, -settings_.most, settings_.most);
  }

  void hold(std::uint32_t id) {
    refused_ += step_[id] != 0;
    step_[id] = 0;
  }

  void hold_boundary() {
    std::vector<Edge> open;  // of vertices that are to move
    for (const auto& chunk : map_->table().chunks())
      for (const auto& e : chunk.geometry->open_edge)
        if (step_[e[0]] != 0 || step_[e[1]] != 0) open.push_back(e);
    std::sort(open.begin(), open.end());
    for (const auto& [a, b] : open)
      if (!std::binary_search(open.begin(), open.end(), Edge{b, a})) {
        hold(a);
        hold(b);
      }
  }

  bool moves(const Geometry& geometry, std::uint32_t f) const {
    const auto& [a, b, c] = geometry.face[f];
    return step_[geometry.vertex_id[a]] != 0 || step_[geometry.vertex_id[b]] != 0 || step_[geometry.vertex_id[c]] != 0;
  }

  void find_faces() {
    for (std::uint32_t c = 0; c < map_->table().size(); ++c)
      for (std::uint32_t f = 0; f < map_->table()[c].geometry->face.size(); ++f)
        if (moves(*map_->table()[c].geometry, f)) faces_.push_back({c, f});
  }

  /// Where a vertex goes.
  Eigen::Vector3f place(const Geometry& geometry, std::uint32_t v) const {
    return geometry.position[v] + step_[geometry.vertex_id[v]] * geometry.normal[v];
  }
  FaceCorners moved_corners(const Geometry& geometry, std::uint32_t f) const {
    const auto& [a, b, c] = geometry.face[f];
    return {place(geometry, a), place(geometry, b), place(geometry, c)};
  }

  /// Leaves the vertices of faces that would turn or shrink too far where they are; false where there are none.
  bool hold_bad_faces() {
    constexpr float kAreaKept = 0.5f;
    const float cosine_least = std::cos(settings_.turn_most);
    std::vector<std::uint32_t> held;
    for (const auto& [c, f] : faces_) {
      const Geometry& geometry = *map_->table()[c].geometry;
      if (!moves(geometry, f)) continue;
      const FaceCorners after = moved_corners(geometry, f), before = face_corners(geometry, f);
      const Eigen::Vector3f area = (after[1] - after[0]).cross(after[2] - after[0]);
      const float area_before = (before[1] - before[0]).cross(before[2] - before[0]).norm();
      const float along = area.dot(geometry.face_normal(f));
      if (along >= cosine_least * area.norm() && area.norm() >= kAreaKept * area_before) continue;
      for (auto v : geometry.face[f]) held.push_back(geometry.vertex_id[v]);
    }
    for (auto id : held) hold(id);
    return !held.empty();
  }

  void reexpress(const FaceRef& ref, PpmEdit& edit) {
    const Geometry& geometry = *map_->table()[ref.chunk].geometry;
    if (!moves(geometry, ref.face)) return;
    Texels& texels = edit.texels(ref.chunk);
    const auto first = geometry.first_texel[ref.face], count = texel_count(geometry.divisions[ref.face]);
    before_.assign(texels.mean.begin() + first, texels.mean.begin() + first + count);
    const DescribedFace face(face_corners(geometry, ref.face), geometry.divisions[ref.face], before_);
    face.reexpress(moved_corners(geometry, ref.face), {&texels.mean[first], count});
  }

  const PpmMap* map_;
  const AdjustSettings& settings_;
  std::vector<AroundVertex> around_;  // by vertex id
  std::vector<float> step_;           // by vertex id, m
  std::vector<FaceRef> faces_;        // with a vertex that was to move
  std::size_t refused_ = 0;
  std::vector<float> before_;
};

}  // namespace

std::shared_ptr<const PpmMap> adjust_vertices(std::shared_ptr<const PpmMap> map, const AdjustSettings& settings,
                                              AdjustCounts* counts) {
  Adjustment adjustment(*map, settings);
  const bool any = adjustment.plan();
  if (counts) *counts = adjustment.counts();
  if (!any) return map;
  PpmEdit edit(std::move(map));
  adjustment.write(edit);
  return edit.commit();
}

}  // namespace ppm
