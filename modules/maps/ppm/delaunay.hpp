#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ppm {

using PlaneTriangle = std::array<std::uint32_t, 3>;

/// A point of the plane rounded to 1/1024, so that triangulations are exact. Coordinates must be within +-10^6.
struct GridPoint {
  std::int32_t x, y;
  static GridPoint of(const Eigen::Vector2f& p);
};
/// Twice the signed area of a triangle, positive when x turns towards y; exact.
inline std::int64_t twice_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) - static_cast<std::int64_t>(c.x - a.x) * (b.y - a.y);
}

/// Delaunay triangulation: indices of triangles with positive area. Of several points at one place all but one are left
/// out. Where more than three points lie on one empty circle (a grid), any of the triangulations is given, always the
/// same for the same points. Source: Boost.Polygon's Voronoi diagram (Fortune's sweep line with exact predicates), of
/// which this is the dual.
std::vector<PlaneTriangle> delaunay(const std::vector<GridPoint>& points);

}  // namespace ppm
