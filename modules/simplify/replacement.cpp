#include "modules/simplify/replacement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppm {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// The same triangle, from its lowest vertex on.
Triangle from_lowest(const Triangle& t) {
  if (t[0] < t[1] && t[0] < t[2]) return t;
  return t[1] < t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

float shape_of(const std::array<Eigen::Vector3f, 3>& p) {
  const Eigen::Vector3f a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
  const float squares = a.squaredNorm() + b.squaredNorm() + c.squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0f) * a.cross(c).norm() / squares : 0;
}

float distance_to_segment(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f e = b - a;
  const float t = std::clamp((p - a).dot(e) / std::max(e.squaredNorm(), 1e-20f), 0.0f, 1.0f);
  return (p - a - t * e).norm();
}

void sort_once(std::vector<std::uint32_t>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace

Replacement::Replacement(const Region& region, const PpmSettings& map, const ReplacementSettings& settings)
    : region_(region), settings_(settings), resampler_(region.textured, map, Meeting::seen) {
  std::vector<std::pair<Edge, std::uint32_t>> edges;
  for (std::uint32_t f = 0; f < region.corner.size(); ++f) {
    const Triangle& t = region.corner[f];
    old_.emplace(from_lowest(t), f);
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({{t[k], t[(k + 1) % 3]}, f});
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [edge, face] : edges) {
    const Edge back{edge[1], edge[0]};
    const auto at = std::lower_bound(edges.begin(), edges.end(), std::pair<Edge, std::uint32_t>{back, 0});
    if (at != edges.end() && at->first == back) continue;
    if (std::binary_search(region.outer.begin(), region.outer.end(), back)) continue;
    border_.push_back({edge[0], edge[1], face});
  }
  first_around_.assign(region.id.size() + 1, 0);
  for (const auto& t : region.corner)
    for (auto v : t) ++first_around_[v + 1];
  std::partial_sum(first_around_.begin(), first_around_.end(), first_around_.begin());
  around_.resize(3 * region.corner.size());
  auto next = first_around_;
  for (std::uint32_t f = 0; f < region.corner.size(); ++f)
    for (auto v : region.corner[f]) around_[next[v]++] = f;
}

const Replacement::Judged& Replacement::judge(const Triangle& triangle) {
  auto [it, fresh] = judged_.try_emplace(triangle);
  Judged& judged = it->second;
  if (!fresh) return judged;
  const std::array<Eigen::Vector3f, 3> corner{region_.position[triangle[0]], region_.position[triangle[1]],
                                              region_.position[triangle[2]]};
  const float shape = shape_of(corner);
  if (!(shape > 0)) return judged;
  judged.face = resampler_.resample(corner, settings_.tolerance);
  const ResampleError& error = judged.face.error;
  judged.sound = shape >= settings_.shape_least && error.share <= 1 && error.offset <= settings_.offset_most &&
                 error.miss <= settings_.border;
  return judged;
}

/// The faces to blame for a triangle: those in whose place it stands, or else those at its corners, which took part.
void Replacement::blame(const Triangle& triangle, const std::vector<std::uint8_t>& stays,
                        std::vector<std::uint32_t>& faults) {
  const auto before = faults.size();
  for (const auto& o : judge(from_lowest(triangle)).face.overlap)
    if (!stays[o.old_face]) faults.push_back(o.old_face);
  if (faults.size() > before) return;
  for (auto v : triangle) blame_vertex(v, stays, faults);
}

void Replacement::blame_vertex(std::uint32_t vertex, const std::vector<std::uint8_t>& stays,
                               std::vector<std::uint32_t>& faults) const {
  for (auto k = first_around_[vertex]; k < first_around_[vertex + 1]; ++k)
    if (!stays[around_[k]]) faults.push_back(around_[k]);
}

std::vector<std::uint32_t> Replacement::with_neighbours(const std::vector<std::uint32_t>& faces) const {
  std::vector<std::uint32_t> all;
  for (auto f : faces)
    for (auto v : region_.corner[f])
      all.insert(all.end(), around_.begin() + first_around_[v], around_.begin() + first_around_[v + 1]);
  sort_once(all);
  return all;
}

/// The directed edges of the region as it would be, ascending.
std::vector<Edge> Replacement::edges_of(const std::vector<Triangle>& proposed,
                                        const std::vector<std::uint8_t>& stays) const {
  std::vector<Edge> edges;
  auto add = [&](const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  };
  for (const auto& t : proposed) add(t);
  for (std::size_t f = 0; f < stays.size(); ++f)
    if (stays[f]) add(region_.corner[f]);
  std::sort(edges.begin(), edges.end());
  return edges;
}

void Replacement::find_double_edges(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays,
                                    const std::vector<Edge>& edges, std::vector<std::uint32_t>& faults) {
  std::vector<Edge> twice;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if ((e > 0 && edges[e] == edges[e - 1]) || std::binary_search(region_.outer.begin(), region_.outer.end(), edges[e]))
      twice.push_back(edges[e]);
  if (twice.empty()) return;
  for (const auto& t : proposed)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::binary_search(twice.begin(), twice.end(), Edge{t[k], t[(k + 1) % 3]})) blame(t, stays, faults);
}

/// Follows the old border, along one of its edges, to the end of a new border edge; false where it does not come there.
/// passed: the edges on the way. strays: how far from the new edge it went, m.
bool Replacement::follow(std::size_t edge, std::uint32_t to, std::vector<std::size_t>& passed, float& strays) const {
  const std::uint32_t from = border_[edge].from;
  passed.clear();
  strays = 0;
  for (;;) {
    passed.push_back(edge);
    const std::uint32_t at = border_[edge].to;
    if (at == to) return true;
    if (region_.locked[at] || passed.size() > border_.size()) return false;  // locked vertices stay, so do not skip them
    strays = std::max(strays,
                      distance_to_segment(region_.position[at], region_.position[from], region_.position[to]));
    edge = first_border_from(at);
    if (edge == border_.size() || border_[edge].from != at) return false;
  }
}

std::size_t Replacement::first_border_from(std::uint32_t vertex) const {
  const auto it = std::lower_bound(border_.begin(), border_.end(), vertex,
                                   [](const BorderEdge& e, std::uint32_t v) { return e.from < v; });
  return static_cast<std::size_t>(it - border_.begin());
}

void Replacement::find_moved_borders(const std::vector<std::uint8_t>& stays, const std::vector<Edge>& edges,
                                     std::vector<std::uint32_t>& faults) const {
  std::vector<std::uint8_t> followed(border_.size(), 0);
  for (const auto& [a, b] : edges) {
    const Edge back{b, a};
    if (std::binary_search(edges.begin(), edges.end(), back) ||
        std::binary_search(region_.outer.begin(), region_.outer.end(), back))
      continue;
    bool found = false;
    for (auto e = first_border_from(a); e < border_.size() && border_[e].from == a && !found; ++e) {
      std::vector<std::size_t> passed;
      float strays = 0;
      found = follow(e, b, passed, strays) && strays <= settings_.border;
      if (found)
        for (auto p : passed) followed[p] = 1;
    }
    if (found) continue;
    blame_vertex(a, stays, faults);
    blame_vertex(b, stays, faults);
  }
  for (std::size_t e = 0; e < border_.size(); ++e)
    if (!followed[e] && !stays[border_[e].face]) faults.push_back(border_[e].face);
}

std::vector<std::uint32_t> Replacement::faults(const std::vector<Triangle>& proposed,
                                               const std::vector<std::uint8_t>& stays) {
  std::vector<std::uint32_t> faults;
  for (const auto& t : proposed) {
    const Triangle key = from_lowest(t);
    if (!old_.contains(key) && !judge(key).sound) blame(t, stays, faults);
  }
  const auto edges = edges_of(proposed, stays);
  find_double_edges(proposed, stays, edges, faults);
  find_moved_borders(stays, edges, faults);
  sort_once(faults);
  return faults;
}

Replacement::Result Replacement::take(const std::vector<Triangle>& proposed, const std::vector<std::uint8_t>& stays) {
  Result result;
  result.goes.resize(stays.size());
  for (std::size_t f = 0; f < stays.size(); ++f) result.goes[f] = !stays[f];
  for (const auto& t : proposed) {
    const Triangle key = from_lowest(t);
    if (const auto it = old_.find(key); it != old_.end()) {
      result.goes[it->second] = 0;
      continue;
    }
    result.triangle.push_back(key);  // in the order of its texels
    result.face.push_back(judge(key).face);
  }
  std::vector<ResampledFace*> faces;
  for (auto& face : result.face) faces.push_back(&face);
  share_votes(region_.textured, faces);
  return result;
}

}  // namespace ppm
