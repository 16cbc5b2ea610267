#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/triangulation.hpp"

using namespace ppm;

namespace {

std::vector<GridPoint> random_points(std::uint32_t seed, int n, int extent) {
  Rng rng(seed, 0, 0, purpose_key("points"));
  std::set<std::pair<int, int>> taken;
  std::vector<GridPoint> points;
  while (static_cast<int>(points.size()) < n) {
    const auto x = static_cast<int>(rng.below(static_cast<std::uint32_t>(extent))),
               y = static_cast<int>(rng.below(static_cast<std::uint32_t>(extent)));
    if (taken.insert({x, y}).second) points.push_back({x, y});
  }
  return points;
}

bool inside_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  return (ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay) +
             (cx * cx + cy * cy) * (ax * by - bx * ay) >
         0.5;
}

/// Twice the area of the convex hull.
std::int64_t hull_area(std::vector<GridPoint> p) {
  std::sort(p.begin(), p.end(),
            [](const GridPoint& a, const GridPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<GridPoint> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const auto& q : p) {
      while (hull.size() >= start + 2 && twice_area(hull[hull.size() - 2], hull.back(), q) <= 0) hull.pop_back();
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  std::int64_t area = 0;
  for (std::size_t k = 2; k < hull.size(); ++k) area += twice_area(hull[0], hull[k - 1], hull[k]);
  return area;
}

/// Positive areas that add up to the hull's, and every directed edge once: a triangulation.
void check_sound(const std::vector<GridPoint>& points, const std::vector<PlaneTriangle>& triangles) {
  std::int64_t area = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : triangles) {
    const auto a = twice_area(points[t[0]], points[t[1]], points[t[2]]);
    CHECK(a > 0);
    area += a;
    for (std::size_t k = 0; k < 3; ++k) CHECK(edges.insert({t[k], t[(k + 1) % 3]}).second);
  }
  CHECK(area == hull_area(points));
}

bool has_edge(const std::vector<PlaneTriangle>& triangles, std::uint32_t a, std::uint32_t b) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const PlaneTriangle& t) {
    return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b);
  });
}

}  // namespace

TEST_CASE("no point lies inside the circle of a Delaunay triangle") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto points =
        random_points(seed, 60, seed % 2 ? 100000 : 12);  // the small extent is full of cocircular points
    const auto triangles = delaunay(points);
    check_sound(points, triangles);
    for (const auto& t : triangles)
      for (std::uint32_t p = 0; p < points.size(); ++p)
        if (p != t[0] && p != t[1] && p != t[2])
          CHECK_FALSE(inside_circle(points[t[0]], points[t[1]], points[t[2]], points[p]));
  }
}

TEST_CASE("points on a line, doubles and too few points give no triangles from nothing") {
  CHECK(delaunay({}).empty());
  CHECK(delaunay({{0, 0}, {5, 5}}).empty());
  CHECK(delaunay({{0, 0}, {5, 5}, {10, 10}, {20, 20}}).empty());
  CHECK(delaunay({{0, 0}, {9, 0}, {0, 9}, {9, 0}}).size() == 1);
}

TEST_CASE("kept edges are in the triangulation, which stays sound") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto points = random_points(seed, 80, 5000);
    Triangulation plane(points);
    Rng rng(seed, 1, 0, purpose_key("edges"));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> kept;
    for (int i = 0; i < 40; ++i) {
      const auto a = rng.below(80), b = rng.below(80);
      if (plane.keep_edge(a, b)) kept.emplace_back(a, b);
    }
    CHECK(kept.size() > 4);
    check_sound(points, plane.triangles());
    for (const auto& [a, b] : kept) CHECK(has_edge(plane.triangles(), a, b));
  }
}

TEST_CASE("an edge across a kept one, through a point, or to a double is refused and changes nothing") {
  const std::vector<GridPoint> points{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {50, 50}, {100, 100}, {40, 130}};
  Triangulation plane(points);
  CHECK_FALSE(plane.keep_edge(0, 2));  // through the point in the middle
  CHECK((plane.keep_edge(0, 4) && plane.keep_edge(4, 2)) !=
        plane.keep_edge(4, 5));           // one of the doubles is in, the other is not
  CHECK(plane.keep_edge(1, 6) == false);  // crosses (4, 2)
}
