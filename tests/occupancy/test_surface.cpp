#include <catch2/catch.hpp>
#include <random>

#include "tests/occupancy/occupancy_world.hpp"

using namespace ppm;

namespace {

const Camera kCamera{80, 60, 70, 70, 39.5, 29.5};

struct Errors {
  double mean_m = 0, worst_m = 0;
};

/// Distances of a mesh's vertices to a plane.
Errors to_plane(const Mesh& mesh, const Eigen::Vector3d& normal, double offset) {
  Errors errors;
  for (const auto& p : mesh.position) {
    const double d = std::abs(normal.normalized().dot(p.cast<double>()) - offset / normal.norm());
    errors.mean_m += d / static_cast<double>(mesh.position.size());
    errors.worst_m = std::max(errors.worst_m, d);
  }
  return errors;
}

}  // namespace

TEST_CASE("the surface lies between voxel centres where the plane is") {
  const Eigen::Vector3d normal(0.2, -0.3, 1);
  auto map = test::empty_grid(0.05, -10, 20);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.005f);
  for (int i = 0; i < 60; ++i) {
    const Pose pose(Eigen::Translation3d(0.01 * i, -0.005 * i, 0.004 * i));
    Frame frame = test::plane_image(kCamera, normal, 1.013 - normal.dot(pose.translation()), 0.005f);
    for (auto& d : frame.depth) d += noise(random);
    map = test::after(std::move(map), frame, pose);
  }
  const Mesh surface = map->mesh(Surface::displaced);
  REQUIRE(surface.face.size() > 500);
  const auto errors = to_plane(surface, normal, 1.013);
  CHECK(errors.mean_m < 0.004);
  CHECK(to_plane(map->mesh(Surface::base), normal, 1.013).mean_m > 0.01);
  std::size_t towards = 0;
  for (const auto& n : surface.normal) towards += n.dot(-normal.cast<float>()) > 0;
  CHECK(towards > surface.normal.size() * 98 / 100);
}

TEST_CASE("faces are between occupied and free voxels, never towards the unknown") {
  const auto map = test::after(test::empty_grid(0.05), test::plane_image(kCamera, {0, 0, 1}, 1.013), Pose::Identity());
  const Mesh faces = map->mesh(Surface::base);
  REQUIRE(faces.face.size() > 100);
  for (const auto& f : faces.face)
    for (auto v : f) CHECK(faces.position[v].z() == Approx(1.0).margin(0.051));
  for (const auto& v : faces.variance) CHECK(v == Approx(0.05 * 0.05 / 12));
  CHECK(test::empty_grid(0.05)->mesh(Surface::base).face.empty());
  CHECK(test::empty_grid(0.05)->mesh(Surface::displaced).face.empty());
}
