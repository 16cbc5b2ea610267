#include "modules/maps/ppm/surface_report.hpp"

#include <algorithm>
#include <cmath>

#include "modules/maps/ppm/chunk_edit.hpp"
#include "modules/maps/ppm/face_grid.hpp"

namespace ppm {
namespace {

constexpr double kFarthest = 1e3;      // m, of a first hit
constexpr double kApart = 0.002;       // m: nearer is the same surface
constexpr double kLayer = 0.05;        // m: farther is another thing
constexpr float kParallel = 0.70711f;  // cosine of 45 degrees

void count_edges(const PpmMap& map, SurfaceReport& report) {
  std::vector<Edge> edges;
  for (const auto& chunk : map.table().chunks()) {
    const Geometry& g = *chunk.geometry;
    report.faces += g.face.size();
    for (const auto& f : g.face) {
      report.area_m2 += 0.5 * (g.position[f[1]] - g.position[f[0]]).cross(g.position[f[2]] - g.position[f[0]]).norm();
      for (std::size_t k = 0; k < 3; ++k) edges.push_back({g.vertex_id[f[k]], g.vertex_id[f[(k + 1) % 3]]});
    }
  }
  // Neighbours in this order are the directed edges between the same two vertices.
  auto key = [](const Edge& e) { return std::minmax(e[0], e[1]); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && key(edges[end]) == key(edges[i])) ++end;
    const bool sound = end - i == 1 || (end - i == 2 && edges[i] != edges[i + 1]);
    report.boundary_edges += end - i == 1;
    report.non_manifold_edges += !sound;
  }
}

void shoot(const FaceGrid& grid, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
           SurfaceReport& report) {
  const auto first = grid.first_hit(origin, direction, 0, kFarthest);
  if (!first) return;
  ++report.rays;
  const auto second = grid.first_hit(origin, direction, first->range + kApart, first->range + kLayer);
  report.second_layers += second && first->normal.dot(second->normal) > kParallel;
}

}  // namespace

SurfaceReport report_surface(const PpmMap& map, const Camera& camera, const std::vector<StampedPose>& path, int rays,
                             Rng rng) {
  SurfaceReport report;
  count_edges(map, report);
  if (path.empty()) return report;
  const FaceGrid grid(map);
  for (int i = 0; i < rays; ++i) {
    const Pose& pose = path[rng.below(static_cast<std::uint32_t>(path.size()))].T_map_camera;
    const double x = rng.uniform() * (camera.cols - 1), y = rng.uniform() * (camera.rows - 1);
    shoot(grid, pose.translation(), (pose.linear() * camera.ray(x, y)).normalized(), report);
  }
  return report;
}

}  // namespace ppm
