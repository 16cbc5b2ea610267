#include "modules/maps/ppm/delaunay.hpp"

#include <boost/polygon/voronoi.hpp>
#include <cmath>

namespace ppm {
namespace {

using Site = boost::polygon::point_data<int>;
using Diagram = boost::polygon::voronoi_diagram<double>;

}  // namespace

GridPoint GridPoint::of(const Eigen::Vector2f& p) {
  return {static_cast<std::int32_t>(std::lround(p.x() * 1024.0f)),
          static_cast<std::int32_t>(std::lround(p.y() * 1024.0f))};
}

std::vector<PlaneTriangle> delaunay(const std::vector<GridPoint>& points) {
  std::vector<PlaneTriangle> triangles;
  if (points.size() < 3) return triangles;
  std::vector<Site> sites;
  sites.reserve(points.size());
  for (const auto& p : points) sites.emplace_back(p.x, p.y);
  Diagram diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);

  triangles.reserve(2 * points.size());
  for (const auto& vertex : diagram.vertices()) {
    // The cells around a Voronoi vertex are the sites on its empty circle, counter-clockwise: a convex polygon, cut as
    // a fan.
    const auto* const first = vertex.incident_edge();
    const auto hub = static_cast<std::uint32_t>(first->cell()->source_index());
    for (const auto* edge = first->rot_next(); edge->rot_next() != first; edge = edge->rot_next()) {
      const auto b = static_cast<std::uint32_t>(edge->cell()->source_index());
      const auto c = static_cast<std::uint32_t>(edge->rot_next()->cell()->source_index());
      const auto area = twice_area(points[hub], points[b], points[c]);
      if (area > 0)
        triangles.push_back({hub, b, c});
      else if (area < 0)
        triangles.push_back({hub, c, b});
    }
  }
  return triangles;
}

}  // namespace ppm
