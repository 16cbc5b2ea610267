#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ppm {

/// Delaunay triangulation of points in the plane: indices of triangles with positive area (x1-x0)(y2-y0) - (x2-x0)(y1-y0) > 0.
/// Points are rounded to 1/1024; of several that round to the same place all but the first are left out. The rounded points are
/// triangulated exactly; where more than three lie on one empty circle (a grid), any of the triangulations is given, always the
/// same for the same points. Coordinates must be within +-10^6.
/// Source: Boost.Polygon's Voronoi diagram (Fortune's sweep line with exact predicates), of which this is the dual.
std::vector<std::array<std::uint32_t, 3>> delaunay(const std::vector<Eigen::Vector2f>& points);

}  // namespace ppm
