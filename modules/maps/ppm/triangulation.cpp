#include "modules/maps/ppm/triangulation.hpp"

#include <algorithm>
#include <deque>

namespace ppm {
namespace {

std::pair<std::uint32_t, std::uint32_t> ordered(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// True when d lies inside the circle through a, b, c (positive area). Exact.
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto row = [&d](const GridPoint& p) {
    const auto x = static_cast<__int128>(p.x - d.x), y = static_cast<__int128>(p.y - d.y);
    return std::array<__int128, 3>{x, y, x * x + y * y};
  };
  const auto u = row(a), v = row(b), w = row(c);
  return u[0] * (v[1] * w[2] - w[1] * v[2]) - u[1] * (v[0] * w[2] - w[0] * v[2]) + u[2] * (v[0] * w[1] - w[0] * v[1]) >
         0;
}

}  // namespace

Triangulation::Triangulation(std::vector<GridPoint> points)
    : point_(std::move(points)), triangle_(delaunay(point_)), around_(point_.size()) {
  for (std::uint32_t t = 0; t < triangle_.size(); ++t) relink(t);
}

void Triangulation::relink(std::uint32_t t) {
  for (auto v : triangle_[t]) around_[v].push_back(t);
}

Triangulation::Side Triangulation::side(std::uint32_t a, std::uint32_t b) const {
  for (auto t : around_[a])
    for (std::uint32_t k = 0; k < 3; ++k)
      if (triangle_[t][k] == a && next(t, k) == b) return {t, k};
  return {};
}

bool Triangulation::is_kept(const Edge& e) const {
  return std::find(kept_.begin(), kept_.end(), ordered(e.first, e.second)) != kept_.end();
}

bool Triangulation::keep_edge(std::uint32_t a, std::uint32_t b) {
  if (a == b || around_[a].empty() || around_[b].empty()) return false;
  if (side(a, b).triangle == kNone && side(b, a).triangle == kNone) {
    std::vector<Edge> edges, made;
    if (!crossed(a, b, edges)) return false;
    std::deque<Edge> todo(edges.begin(), edges.end());
    while (!todo.empty()) {
      const Edge e = todo.front();
      todo.pop_front();
      Edge flipped;
      if (!flip(e, flipped))
        todo.push_back(e);  // its quadrilateral becomes convex once its neighbours have been flipped
      else if (crosses(flipped, a, b))
        todo.push_back(flipped);
      else
        made.push_back(flipped);
    }
    mend(std::move(made), a, b);
  }
  kept_.push_back(ordered(a, b));
  return true;
}

/// The edges that the segment from a to b crosses; false where it meets a point or a kept edge, or leaves the
/// triangulation.
bool Triangulation::crossed(std::uint32_t a, std::uint32_t b, std::vector<Edge>& edges) const {
  Edge e{kNone, kNone};
  for (auto t : around_[a])
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto u = triangle_[t][k], w = next(t, k);
      if (u != a && w != a && crosses({u, w}, a, b)) e = {u, w};
    }
  while (e.first != kNone) {
    if (is_kept(e)) return false;
    edges.push_back(e);
    const Side beyond = side(e.second, e.first);  // e runs along the near triangle, so its reverse along the far one
    if (beyond.triangle == kNone) return false;
    const auto tip = apex(beyond);
    if (tip == b) return true;
    if (crosses({e.first, tip}, a, b))
      e = {e.first, tip};
    else if (crosses({tip, e.second}, a, b))
      e = {tip, e.second};
    else
      return false;
  }
  return false;
}

bool Triangulation::crosses(const Edge& e, std::uint32_t a, std::uint32_t b) const {
  if (e.first == a || e.first == b || e.second == a || e.second == b) return false;
  const auto &p = point_[e.first], &q = point_[e.second], &from = point_[a], &to = point_[b];
  const auto s1 = twice_area(from, to, p), s2 = twice_area(from, to, q), s3 = twice_area(p, q, from),
             s4 = twice_area(p, q, to);
  return ((s1 > 0 && s2 < 0) || (s1 < 0 && s2 > 0)) && ((s3 > 0 && s4 < 0) || (s3 < 0 && s4 > 0));
}

/// Replaces an edge by the other diagonal of its quadrilateral; false where that is not strictly convex.
bool Triangulation::flip(const Edge& e, Edge& flipped) {
  const Side left = side(e.first, e.second), right = side(e.second, e.first);
  if (left.triangle == kNone || right.triangle == kNone) return false;
  const auto p = apex(left), q = apex(right);
  if (twice_area(point_[p], point_[q], point_[e.second]) <= 0 || twice_area(point_[q], point_[p], point_[e.first]) <= 0)
    return false;
  for (auto t : {left.triangle, right.triangle})
    for (auto v : triangle_[t]) around_[v].erase(std::find(around_[v].begin(), around_[v].end(), t));
  triangle_[left.triangle] = {p, q, e.second};
  triangle_[right.triangle] = {q, p, e.first};
  relink(left.triangle);
  relink(right.triangle);
  flipped = {p, q};
  return true;
}

/// Makes the edges that flipping has made Delaunay again, but for (a, b).
void Triangulation::mend(std::vector<Edge> made, std::uint32_t a, std::uint32_t b) {
  for (bool changed = true; changed;) {
    changed = false;
    for (Edge& e : made) {
      if (ordered(e.first, e.second) == ordered(a, b) || is_delaunay(e)) continue;
      if (flip(e, e)) changed = true;
    }
  }
}

bool Triangulation::is_delaunay(const Edge& e) const {
  const Side left = side(e.first, e.second), right = side(e.second, e.first);
  if (left.triangle == kNone || right.triangle == kNone) return true;
  const auto& t = triangle_[left.triangle];
  return !in_circle(point_[t[0]], point_[t[1]], point_[t[2]], point_[apex(right)]);
}

}  // namespace ppm
