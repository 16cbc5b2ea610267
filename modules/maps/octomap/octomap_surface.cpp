#include "modules/maps/octomap/octomap_surface.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>

namespace ppm {

namespace {

std::uint16_t key_at(int index) {
  return static_cast<std::uint16_t>(std::clamp(index, 0, 0xffff));
}

OctomapCell neighbour(const OctomapCell& cell, int dx, int dy, int dz) {
  return {key_at(cell[0] + dx), key_at(cell[1] + dy), key_at(cell[2] + dz)};
}

}  // namespace

OctomapSurface::OctomapSurface(const octomap::OcTree& tree, OctomapPlace place)
    : tree_(tree), place_(place), lookup_(tree) {}

std::optional<OctomapSurface::Point> OctomapSurface::look(const Eigen::Vector3d& origin,
                                                          const Eigen::Vector3d& direction, double range_most_m) {
  const auto hit = cast_ray(tree_, lookup_, origin, direction, range_most_m);
  if (!hit) return std::nullopt;
  Point point;
  switch (place_) {
    case OctomapPlace::centre:
      point.range_m = (centre_of(tree_, hit->cell) - origin).dot(direction);
      break;
    case OctomapPlace::face:
      point.range_m = hit->enters_m;
      break;
    case OctomapPlace::middle:
      point.range_m = (hit->enters_m + hit->leaves_m) / 2;
      break;
  }
  point.normal = normal_of(hit->cell);
  return point;
}

const Eigen::Vector3f& OctomapSurface::normal_of(const OctomapCell& cell) {
  const auto key = std::uint64_t{cell[0]} | std::uint64_t{cell[1]} << 16 | std::uint64_t{cell[2]} << 32;
  const auto [it, added] = normals_.try_emplace(key);
  if (!added) return it->second;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz) {
        const double weight = 1.0 / (1 << (std::abs(dx) + std::abs(dy) + std::abs(dz)));  // Sobel's
        gradient += weight * lookup_.log_odds(neighbour(cell, dx, dy, dz)) * Eigen::Vector3d(dx, dy, dz);
      }
  const double length = gradient.norm();
  it->second = length > 1e-6 ? Eigen::Vector3f((-gradient / length).cast<float>()) : Eigen::Vector3f::Zero();
  return it->second;
}

}  // namespace ppm
