#include "modules/maps/ppm/meshed_room.hpp"

#include <cmath>

#include "framework/core/rng.hpp"

namespace ppm {
namespace {

/// A grid of squares over the parallelogram o + s a + t b; free space lies on the side of a x b.
void add_patch(TriangleMesh& mesh, const Eigen::Vector3f& o, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
               float edge) {
  const int na = static_cast<int>(std::ceil(a.norm() / edge)), nb = static_cast<int>(std::ceil(b.norm() / edge));
  const Eigen::Vector3f normal = a.cross(b).normalized();
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (na + 1) + i); };
  for (int j = 0; j <= nb; ++j)
    for (int i = 0; i <= na; ++i) {
      const Eigen::Vector3f p =
          o + static_cast<float>(i) / static_cast<float>(na) * a + static_cast<float>(j) / static_cast<float>(nb) * b;
      mesh.position.push_back(p + 0.02f * std::sin(7 * p.sum()) * normal);
    }
  for (int j = 0; j < nb; ++j)
    for (int i = 0; i < na; ++i) {
      mesh.face.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.face.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

/// The six sides of a box, seen from outside, or from inside.
void add_box(TriangleMesh& mesh, const Eigen::Vector3f& o, const Eigen::Vector3f& size, float edge, bool inside) {
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3f a = Eigen::Vector3f::Zero(), b = a, c = a;
    a[(k + 1) % 3] = size[(k + 1) % 3];
    b[(k + 2) % 3] = size[(k + 2) % 3];
    c[k] = size[k];
    add_patch(mesh, o, inside ? a : b, inside ? b : a, edge);
    add_patch(mesh, o + c, inside ? b : a, inside ? a : b, edge);
  }
}

}  // namespace

TriangleMesh meshed_room(int faces) {
  constexpr float kArea = 150;  // m^2, of walls and boxes
  const float edge = std::sqrt(2 * kArea / static_cast<float>(faces));
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {6, 5, 2.7f}, edge, true);
  Rng rng(5, 0, 0, 0);
  for (int i = 0; i < 10; ++i) {
    auto between = [&](double a, double b) { return static_cast<float>(a + (b - a) * rng.uniform()); };
    const float x = between(0.2, 5), y = between(0.2, 4);
    const float width = between(0.3, 0.9), depth = between(0.3, 0.9), height = between(0.3, 1.2);
    add_box(mesh, {x, y, 0.1f}, {width, depth, height}, edge, false);
  }
  return mesh;
}

Pose room_view(double angle) {
  Pose view = Pose::Identity();
  view.translation() << 3 + std::cos(angle), 2.5 + std::sin(angle), 1.5;
  Eigen::Matrix3d R;
  R.col(2) = Eigen::Vector3d(std::cos(angle), std::sin(angle), -0.2).normalized();
  R.col(0) = R.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  view.linear() = R;
  return view;
}

}  // namespace ppm
