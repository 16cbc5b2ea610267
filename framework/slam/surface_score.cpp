#include "framework/slam/surface_score.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/rng.hpp"
#include "framework/core/timing.hpp"
#include "framework/slam/nearest_triangle.hpp"

namespace ppm {

namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr std::size_t kBatch = 1024;

/// At most `count` of the points, evenly.
Points thinned(const Points& points, std::size_t count) {
  if (points.size() <= count) return points;
  Points out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) out.push_back(points[i * points.size() / count]);
  return out;
}

/// distance(point) of each point moved by T, m.
template <class F>
SurfaceDistances distances(const Points& points, const Pose& T, const Workers& workers, F distance) {
  std::vector<double> d(points.size());
  workers.for_each((points.size() + kBatch - 1) / kBatch, [&](std::size_t batch, int) {
    for (std::size_t i = batch * kBatch; i < std::min((batch + 1) * kBatch, points.size()); ++i)
      d[i] = distance(Eigen::Vector3d(T * points[i].cast<double>()));
  });
  auto within = [&](double limit_m) {
    const auto near = std::ranges::count_if(d, [=](double x) { return x <= limit_m; });
    return d.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(d.size());
  };
  return {d.size(), 1e3 * quantile(d, 0.5), 1e3 * mean(d), within(0.01), within(0.02), within(0.05)};
}

/// The mesh's faces; of a mesh without any each vertex as a face of no size.
std::vector<NearestTriangle::Face> faces_of(const Mesh& mesh) {
  if (!mesh.face.empty()) return mesh.face;
  std::vector<NearestTriangle::Face> faces;
  faces.reserve(mesh.position.size());
  for (std::uint32_t v = 0; v < mesh.position.size(); ++v) faces.push_back({v, v, v});
  return faces;
}

}  // namespace

double SurfaceScore::f_score() const {
  const double sum = precision() + recall();
  return sum > 0 ? 2 * precision() * recall() / sum : 0;
}

std::vector<Eigen::Vector3f> sample_surface(const Mesh& mesh, std::size_t count) {
  if (mesh.face.empty()) return thinned(mesh.position, count);
  std::vector<double> area_up_to;
  area_up_to.reserve(mesh.face.size());
  double area = 0;
  for (const auto& [a, b, c] : mesh.face) {
    const Eigen::Vector3f ab = mesh.position[b] - mesh.position[a], ac = mesh.position[c] - mesh.position[a];
    area += 0.5 * static_cast<double>(ab.cross(ac).norm());
    area_up_to.push_back(area);
  }
  Points points;
  points.reserve(count);
  static const std::uint32_t purpose = purpose_key("surface/samples");
  for (std::size_t i = 0; i < count; ++i) {
    Rng rng(1, static_cast<std::uint32_t>(i), 0, purpose);
    const auto at = std::ranges::upper_bound(area_up_to, rng.uniform() * area);
    const auto& [a, b, c] = mesh.face[static_cast<std::size_t>(std::min(at, area_up_to.end() - 1) - area_up_to.begin())];
    // Uniform over the triangle: Osada et al., ACM ToG 21(4), 2002, section 4.2.
    const auto root = static_cast<float>(std::sqrt(rng.uniform())), v = static_cast<float>(rng.uniform());
    points.push_back((1 - root) * mesh.position[a] + root * (1 - v) * mesh.position[b] + root * v * mesh.position[c]);
  }
  return points;
}

SurfaceScore score_surface(const Mesh& mesh, const Pose& T_world_map, const TrueSurface& truth,
                           const std::vector<Eigen::Vector3f>& seen, const Workers& workers) {
  SurfaceScore score;
  score.accuracy = distances(sample_surface(mesh, kSurfaceSamples), T_world_map, workers,
                             [&](const Eigen::Vector3d& p) { return truth.distance(p); });
  const NearestTriangle surface(mesh.position, faces_of(mesh));
  score.completeness = distances(thinned(seen, kSurfaceSamples), T_world_map.inverse(), workers,
                                 [&](const Eigen::Vector3d& p) { return surface.distance(p.cast<float>()); });
  return score;
}

}  // namespace ppm
