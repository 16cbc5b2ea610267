#include "modules/maps/ppm/delaunay.hpp"

#include <boost/polygon/voronoi.hpp>
#include <cmath>

namespace ppm {
namespace {

constexpr float kScale = 1024.0f;

using Site = boost::polygon::point_data<int>;
using Diagram = boost::polygon::voronoi_diagram<double>;

std::int64_t area(const Site& a, const Site& b, const Site& c) {
  return static_cast<std::int64_t>(b.x() - a.x()) * (c.y() - a.y()) - static_cast<std::int64_t>(c.x() - a.x()) * (b.y() - a.y());
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> delaunay(const std::vector<Eigen::Vector2f>& points) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (points.size() < 3) return triangles;
  std::vector<Site> sites;
  sites.reserve(points.size());
  for (const auto& p : points) sites.emplace_back(static_cast<int>(std::lround(p.x() * kScale)), static_cast<int>(std::lround(p.y() * kScale)));
  Diagram diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);

  triangles.reserve(2 * points.size());
  for (const auto& vertex : diagram.vertices()) {
    // The cells around a Voronoi vertex are the sites on its empty circle, counter-clockwise: a convex polygon, cut as a fan.
    const auto* const first = vertex.incident_edge();
    const auto hub = static_cast<std::uint32_t>(first->cell()->source_index());
    for (const auto* edge = first->rot_next(); edge->rot_next() != first; edge = edge->rot_next()) {
      const auto b = static_cast<std::uint32_t>(edge->cell()->source_index());
      const auto c = static_cast<std::uint32_t>(edge->rot_next()->cell()->source_index());
      const auto twice = area(sites[hub], sites[b], sites[c]);
      if (twice > 0) triangles.push_back({hub, b, c});
      else if (twice < 0) triangles.push_back({hub, c, b});
    }
  }
  return triangles;
}

}  // namespace ppm
