#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "modules/sources/room_path.hpp"
#include "modules/sources/room_scene.hpp"
#include "modules/sources/scene_builder.hpp"

using namespace ppm;
using Eigen::Vector3d;

namespace {

Vector3d random_direction(Rng& rng) {
  return Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

/// The same answer by other formulas: steps along the ray as far as the distance to the nearest surface allows.
double march(const AnalyticScene& scene, const Vector3d& origin, const Vector3d& direction, double far) {
  double range = 0;
  for (int step = 0; step < 20000 && range < far; ++step) {
    const double d = scene.distance(origin + range * direction);
    if (d < 1e-7) return range;
    range += d;
  }
  return INFINITY;
}

/// Rays that pass a surface closely stop there when marching; how far they are from it decides whether a difference
/// counts.
void compare_with_marching(const AnalyticScene& scene, const Vector3d& origin, const Vector3d& direction) {
  const SceneHit hit = scene.cast(origin, direction);
  const double marched = march(scene, origin, direction, 50);
  INFO("origin " << origin.transpose() << " direction " << direction.transpose() << " cast " << hit.range_m
                 << " marched " << marched);
  if (hit.solid == SceneHit::kNone) {
    CHECK(marched == INFINITY);
    return;
  }
  CHECK(hit.range_m == Approx(marched).margin(1e-6 / std::max(0.01, -hit.normal.dot(direction)) + 1e-6));
  const Vector3d p = origin + hit.range_m * direction;
  CHECK(std::abs(scene.distance(p)) < 1e-9);
  CHECK(hit.normal.norm() == Approx(1));
  CHECK(hit.normal.dot(direction) <= 0);
}

}  // namespace

TEST_CASE("rays meet each kind of solid where marching does") {
  SceneBuilder builder;
  Rng rng(3, 0, 0, 0);
  builder.begin_object("solids");
  for (int i = 0; i < 30; ++i) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(3 * rng.uniform(), random_direction(rng)).toRotationMatrix();
    const Vector3d center = 4 * Vector3d(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5);
    const double radius = 0.05 + 0.3 * rng.uniform(), height = 0.05 + 0.5 * rng.uniform();
    switch (i % 3) {
      case 0:
        builder.add(Solid::Shape::box, center, {radius, height, 0.1}, {0.5f, 0.5f, 0.5f}, R);
        break;
      case 1:
        builder.add(Solid::Shape::cylinder, center, {radius, radius, height}, {0.5f, 0.5f, 0.5f}, R);
        break;
      default:
        builder.add(Solid::Shape::sphere, center, {radius, radius, radius}, {0.5f, 0.5f, 0.5f}, R);
    }
  }
  const AnalyticScene scene = builder.build();
  for (int i = 0; i < 3000; ++i) compare_with_marching(scene, 5 * random_direction(rng), random_direction(rng));
}

TEST_CASE("rays along the axes and along faces are exact") {
  SceneBuilder builder;
  builder.begin_object("box");
  builder.add(Solid::Shape::box, {0, 0, 0}, {1, 1, 1}, {0.5f, 0.5f, 0.5f});
  builder.begin_object("cylinder");
  builder.add(Solid::Shape::cylinder, {5, 0, 0}, {1, 1, 2}, {0.5f, 0.5f, 0.5f});
  const AnalyticScene scene = builder.build();
  const SceneHit top = scene.cast({0, 0, 5}, -Vector3d::UnitZ());
  CHECK(top.range_m == 4);
  CHECK(top.normal == Vector3d::UnitZ());
  CHECK(scene.object_of(top.solid).name == "box");
  const SceneHit lid = scene.cast({5.5, 0, 5}, -Vector3d::UnitZ());
  CHECK(lid.range_m == 3);
  CHECK(scene.object_of(lid.solid).name == "cylinder");
  CHECK(scene.cast({5, -3, 0}, Vector3d::UnitY()).normal == -Vector3d::UnitY());
  CHECK(scene.cast({5, -3, 2.5}, Vector3d::UnitY()).solid == SceneHit::kNone);
  CHECK(scene.cast({-5, 3, 0}, Vector3d::UnitX()).solid == SceneHit::kNone);
  CHECK(scene.cast({0, 0, 0}, Vector3d::UnitX()).range_m == 4);  // from inside the box: it is not seen
  CHECK(scene.cast_among({0}, {0, 0, 0}, Vector3d::UnitX()).solid == SceneHit::kNone);
}

TEST_CASE("rays meet the furnished room where marching does, and none leaves it") {
  const AnalyticScene room = make_room();
  Rng rng(5, 0, 0, 0);
  for (int i = 0; i < 1500; ++i) {
    const Vector3d origin = room_camera_pose(0.2 * i).translation(), direction = random_direction(rng);
    REQUIRE(room.cast(origin, direction).solid != SceneHit::kNone);
    compare_with_marching(room, origin, direction);
  }
}

TEST_CASE("the camera's path is smooth, slow enough to follow, and clear of the furniture") {
  const AnalyticScene room = make_room();
  for (int i = 0; i < 3000; ++i) {
    const Pose a = room_camera_pose(i / kRoomRateHz), b = room_camera_pose((i + 1) / kRoomRateHz);
    const Pose c = room_camera_pose((i + 2) / kRoomRateHz);
    const Pose first = a.inverse() * b, second = b.inverse() * c;
    INFO("frame " << i);
    CHECK(first.translation().norm() < 0.02);
    CHECK(rotation_angle(first) < 1.5 * EIGEN_PI / 180);
    CHECK((first.inverse() * second).translation().norm() < 0.003);  // what a constant velocity misses
    CHECK(rotation_angle(first.inverse() * second) < 0.2 * EIGEN_PI / 180);
    CHECK(room.distance(a.translation()) > 0.4);
    CHECK((a.linear().transpose() * a.linear() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    CHECK(a.linear().determinant() == Approx(1));
    CHECK(a.linear()(2, 1) < -0.8);  // image rows grow downwards
  }
}

TEST_CASE("the path closes a loop") {
  const Pose start = room_camera_pose(0), later = room_camera_pose(370 / kRoomRateHz);
  const Pose back = start.inverse() * later;
  CHECK(back.translation().norm() < 0.15);
  CHECK(rotation_angle(back) < 10 * EIGEN_PI / 180);
}

TEST_CASE("a pattern alternates from cell to cell, in the solid's axes, and an infinite size makes stripes") {
  Solid solid{Solid::Shape::box, {1, 2, 3}};
  solid.R_world_local = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  solid.albedo = {1, 0, 0};
  CHECK(albedo_at(solid, {1.3, 2, 3}) == Eigen::Vector3f(1, 0, 0));
  solid.pattern = {{0.2, INFINITY, INFINITY}, {0, 0, 1}};
  for (double y : {2.05, 1.95, 2.41}) CHECK(albedo_at(solid, {1.3, y, 2.6}) == Eigen::Vector3f(1, 0, 0));
  for (double y : {2.15, 1.85, 2.25}) CHECK(albedo_at(solid, {0.7, y, 3.2}) == Eigen::Vector3f(0, 0, 1));
  solid.pattern.size = {0.2, 0.1, 0.1};
  CHECK(albedo_at(solid, {1.0, 2.15, 3.1}) == Eigen::Vector3f(1, 0, 0));  // two cells on
}
