#include "tests/prediction/outline.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ppm::test {
namespace {

constexpr double kNear = 1e-4;  // m

std::vector<Eigen::Vector2d> image_of(const std::array<Eigen::Vector3d, 3>& corner, const Camera& camera) {
  std::vector<Eigen::Vector2d> outline;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d &a = corner[k], &b = corner[(k + 1) % 3];
    if (a.z() >= kNear) outline.push_back(camera.project(a));
    if ((a.z() >= kNear) != (b.z() >= kNear))
      outline.push_back(camera.project(a + (kNear - a.z()) / (b.z() - a.z()) * (b - a)));
  }
  return outline;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

OutlineDistance outline_distance(const std::array<Eigen::Vector3d, 3>& corner, const Camera& camera,
                                 const Eigen::Vector2d& pixel) {
  const auto outline = image_of(corner, camera);
  OutlineDistance found{INFINITY, !outline.empty()};
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) area += cross(outline[i], outline[(i + 1) % outline.size()]);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d a = outline[i] - pixel, along = outline[(i + 1) % outline.size()] - outline[i];
    const double t = along.squaredNorm() > 0 ? std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
    found.px = std::min(found.px, (a + t * along).norm());
    found.inside &= cross(along, -a) * area >= 0;
  }
  return found;
}

}  // namespace ppm::test
