// Rays through an octree against OctoMap's own castRay.
#include <catch2/catch.hpp>
#include <octomap/OcTree.h>
#include <random>

#include "modules/maps/octomap/octomap_map.hpp"
#include "modules/maps/octomap/octomap_surface.hpp"
#include "tests/support/box_images.hpp"

using namespace ppm;

namespace {

OctomapMap box_map(double resolution_m) {
  OctomapMap map(resolution_m, 0.5);
  for (const auto& view : test::box_views()) map.insert(test::box_image(test::box_camera(), view), view, {});
  return map;
}

Eigen::Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

octomap::point3d point(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

TEST_CASE("rays end in the cell that OcTree::castRay finds") {
  const double resolution_m = GENERATE(0.05, 0.11);
  const double range_most_m = GENERATE(20.0, 1.8);
  const auto map = box_map(resolution_m);
  OctomapLookup lookup(map.tree());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.9, 0.9);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d origin(place(random), place(random), place(random)), direction = random_direction(random);
    octomap::point3d end;
    const bool expected = map.tree().castRay(point(origin), point(direction), end, true, range_most_m);
    const auto hit = cast_ray(map.tree(), lookup, origin, direction, range_most_m);
    REQUIRE(hit.has_value() == expected);
    if (!hit) continue;
    ++hits;
    const auto key = map.tree().coordToKey(end);
    CHECK(hit->cell == OctomapCell{key[0], key[1], key[2]});
    CHECK(hit->leaves_m > hit->enters_m);
  }
  CHECK(hits > (range_most_m > 10 ? 1500 : 200));
}

TEST_CASE("rays along axes and from the edges of cells end where castRay's do") {
  const auto map = box_map(0.05);
  OctomapLookup lookup(map.tree());
  for (const double shift : {0.0, 0.025, 0.05})
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const Eigen::Vector3d origin = Eigen::Vector3d::Constant(shift), direction = sign * Eigen::Vector3d::Unit(axis);
        octomap::point3d end;
        const bool expected = map.tree().castRay(point(origin), point(direction), end, true, 20);
        const auto hit = cast_ray(map.tree(), lookup, origin, direction, 20);
        REQUIRE(hit.has_value() == expected);
        if (hit) CHECK((centre_of(map.tree(), hit->cell).cast<float>() - Eigen::Vector3f(end.x(), end.y(), end.z())).norm() < 1e-4f);
      }
}

TEST_CASE("an empty tree and an origin outside of its space show nothing") {
  const OctomapMap map(0.05, 0.5);
  OctomapLookup lookup(map.tree());
  CHECK_FALSE(cast_ray(map.tree(), lookup, {0, 0, 0}, {1, 0, 0}, 20));
  CHECK_FALSE(cast_ray(map.tree(), lookup, {1e6, 0, 0}, {1, 0, 0}, 20));
}

TEST_CASE("what lookups find is what OcTree::search finds") {
  const auto map = box_map(0.05);
  OctomapLookup lookup(map.tree());
  std::mt19937 random(3);
  std::uniform_int_distribution<int> cell(-60, 60);
  for (int i = 0; i < 5000; ++i) {
    const OctomapCell at = {static_cast<std::uint16_t>(0x8000 + cell(random)), static_cast<std::uint16_t>(0x8000 + cell(random)),
                            static_cast<std::uint16_t>(0x8000 + cell(random))};
    CHECK(lookup.leaf(at) == map.tree().search(octomap::OcTreeKey(at[0], at[1], at[2])));
  }
}

TEST_CASE("every place of the surface is within two cells of the wall, and normals face the room") {
  const auto place = GENERATE(OctomapPlace::centre, OctomapPlace::face, OctomapPlace::middle);
  const double resolution_m = 0.05;
  const auto map = box_map(resolution_m);
  OctomapSurface surface(map.tree(), place);
  const auto views = test::box_views();
  const auto camera = test::box_camera();
  int right = 0, seen = 0;
  for (int y = 2; y < camera.rows; y += 5)
    for (int x = 2; x < camera.cols; x += 5) {
      const Eigen::Vector3d direction = (views[0].linear() * camera.ray(x, y)).normalized();
      const double truth = test::box_range(views[0].translation(), direction);
      const auto point = surface.look(views[0].translation(), direction, 20);
      if (!point) continue;
      ++seen;
      right += std::abs(point->range_m - truth) < 2 * resolution_m &&
               point->normal.cast<double>().dot(direction) < -0.2;
    }
  CHECK(seen > 180);
  CHECK(right > 0.9 * seen);
}
