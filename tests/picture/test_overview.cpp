#include <catch2/catch.hpp>

#include "modules/maps/picture/canvas.hpp"
#include "modules/maps/picture/mesh_renderer.hpp"
#include "modules/maps/picture/overview.hpp"
#include "modules/maps/picture/path_drawing.hpp"
#include "tests/support/box_room.hpp"

using namespace ppm;

namespace {

// A camera at p that looks along x, pitched down; z is up.
Pose looking_along_x(const Eigen::Vector3d& p, double pitch_down) {
  Pose T = Pose::Identity();
  T.linear().col(0) = Eigen::Vector3d(0, -1, 0);
  T.linear().col(1) = Eigen::Vector3d(0, 0, -1);
  T.linear().col(2) = Eigen::Vector3d(1, 0, 0);
  T.linear() = T.linear() * Eigen::AngleAxisd(-pitch_down, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T.translation() = p;
  return T;
}

Mesh rotated(Mesh mesh, const Eigen::Quaternionf& q) {
  for (auto& p : mesh.position) p = q * p;
  for (auto& n : mesh.normal) n = q * n;
  return mesh;
}

}  // namespace

TEST_CASE("up is found from the floor, though cameras look down") {
  const Eigen::Quaternionf q(Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized()));
  const Mesh mesh = rotated(test::box_room(5, 4, 2.5f), q);
  std::vector<Pose> path;
  for (int i = 0; i < 5; ++i) path.push_back(Pose(q.cast<double>()) * looking_along_x({1, 1, 1.5}, 0.5));
  const Eigen::Vector3d up = estimate_up(mesh, path);
  CHECK((up - q.cast<double>() * Eigen::Vector3d::UnitZ()).norm() < 1e-5);
}

TEST_CASE("without a mesh, up is against the cameras' y axes, without a path it is z") {
  CHECK(estimate_up({}, {looking_along_x({0, 0, 0}, 0)}).isApprox(Eigen::Vector3d::UnitZ()));
  CHECK(estimate_up({}, {}) == Eigen::Vector3d::UnitZ());
}

TEST_CASE("an overview contains the room, fills the picture, and looks into the room from above") {
  const Mesh mesh = test::box_room(5, 4, 2.5f);
  const std::vector<Pose> path{looking_along_x({2, 2, 1.5}, 0.3)};
  for (const auto& [cols, rows] : {std::pair{320, 240}, std::pair{240, 320}, std::pair{400, 100}}) {
    const View view = overview(mesh, path, Eigen::Vector3d::UnitZ(), 0.6, 0.75, cols, rows);
    CHECK(view.T_map_camera.linear().determinant() == Approx(1));
    CHECK(view.T_map_camera.translation().z() > 2.5);
    Eigen::AlignedBox2d box;
    for (const auto& face : mesh.face) {
      auto corner = [&](std::size_t k) -> Eigen::Vector3d {
        return view.T_map_camera.inverse() * mesh.position[face[k]].cast<double>();
      };
      if ((corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(0)) >= 0) continue;  // seen from behind
      for (std::size_t k = 0; k < 3; ++k) box.extend(view.camera.project(corner(k)));
    }
    CHECK(box.min().minCoeff() > -0.5);
    CHECK(box.max().x() < cols - 0.5);
    CHECK(box.max().y() < rows - 0.5);
    CHECK(std::max(box.sizes().x() / cols, box.sizes().y() / rows) > 0.85);

    Canvas canvas(view.camera, view.T_map_camera, 1);
    draw_mesh(canvas, mesh, Show::shaded, std::nullopt, Eigen::Vector3f::UnitZ());
    // Neither ceiling nor near walls stand before the middle of the floor.
    const Eigen::Vector3d floor = view.T_map_camera.inverse() * Eigen::Vector3d(2.5, 2, 0);
    const Eigen::Vector2d at = view.camera.project(floor);
    CHECK(canvas.depth(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))) ==
          Approx(floor.z()).epsilon(0.02));
  }
}

TEST_CASE("of four quarters the one that shows most surface is taken") {
  // A floor and one wall at x = 0 that looks along +x: it is seen only from the side of +x.
  Mesh mesh = test::box_room(4, 4, 2);
  mesh.face = {mesh.face[0], mesh.face[1], mesh.face[8], mesh.face[9]};
  const View view = overview(mesh, {}, Eigen::Vector3d::UnitZ(), 0.0, 0.5, 100, 100);
  CHECK(view.T_map_camera.translation().x() > 4);
  CHECK(std::abs(view.T_map_camera.linear().col(2).y()) < 1e-6);
}

TEST_CASE("an overview of nothing, of a point, and from straight above is still a view") {
  CHECK(is_finite(overview({}, {}, Eigen::Vector3d::UnitZ(), 0.6, 0.75, 64, 48).T_map_camera));
  CHECK(is_finite(overview({}, {Pose::Identity()}, Eigen::Vector3d::UnitZ(), 0.6, 0.75, 64, 48).T_map_camera));
  CHECK(is_finite(
      overview(test::box_room(2, 2, 2), {}, Eigen::Vector3d::UnitZ(), 0.6, 1.57079632679489662, 64, 48).T_map_camera));
}

TEST_CASE("a frustum stands at its camera and opens forwards") {
  const Pose T = looking_along_x({1, 2, 3}, 0);
  const auto lines = frustum(T, 0.5);
  CHECK(lines[1][1].isApprox(Eigen::Vector3d(1, 2, 3)));
  for (const auto& p : lines[0]) CHECK(p.x() == Approx(1.5));
  CHECK(lines[3][1].z() > lines[0][0].z());  // the roof is above
}
