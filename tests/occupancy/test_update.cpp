#include <catch2/catch.hpp>

#include "modules/maps/vdb/vdb_reader.hpp"
#include "tests/occupancy/dense_grid.hpp"
#include "tests/occupancy/occupancy_world.hpp"
#include "tests/support/simd_targets.hpp"

using namespace ppm;
using test::VdbPtr;

namespace {

/// Share of the voxels of a cube in which two grids differ: in what is known, or by more than rounding.
double differing(const VdbMap& map, test::DenseGrid& dense, int n, double tolerance) {
  VdbReader reader(map);
  int differ = 0, known = 0;
  for (int x = -n; x < n; ++x)
    for (int y = -n; y < n; ++y)
      for (int z = -n; z < n; ++z) {
        const double wanted = dense.at(x, y, z);
        const VdbCode code = reader(x, y, z);
        known += !std::isnan(wanted);
        if (std::isnan(wanted) != (code == kVdbUnknown))
          ++differ;
        else if (code != kVdbUnknown && std::abs(code * map.step() - wanted) > tolerance)
          ++differ;
      }
  REQUIRE(known > n * n * n / 2);
  return differ / static_cast<double>(known);
}

}  // namespace

TEST_CASE("the grid is what each voxel would make of each image by itself") {
  OccupancySettings settings;
  double voxel = 0.05;
  SECTION("as it is") {}
  SECTION("a wide ramp, no memory's end") {
    settings.width_sigmas = 30;
    settings.memory = 0;
  }
  SECTION("cut off at a range, thin") {
    settings.max_range_m = 0.9;
    settings.thickness_voxels = 0.5;
  }
  SECTION("coarse voxels") { voxel = 0.11; }
  const int n = static_cast<int>(1.3 / voxel);
  auto map = test::empty_grid(voxel);
  test::DenseGrid dense(n, voxel, -4, 6);
  for (int i = 0; i < 12; ++i) {
    const Pose pose = test::pose_in_box(i);
    const Frame frame = test::box_image(pose);
    map = test::after(std::move(map), frame, pose, settings);
    dense.update(frame, pose, settings);
  }
  // Centres within single precision of a pixel's edge fall on either side.
  CHECK(differing(*map, dense, n, 0.01) < 2e-4);
}

TEST_CASE("the same bytes for any number of threads") {
  for (auto form : {OccupancyForm::profile, OccupancyForm::literal}) {
    OccupancySettings settings;
    settings.form = form;
    const auto one = test::box_map(test::empty_grid(0.04), 0, 5, settings);
    const auto two = test::box_map(test::empty_grid(0.04), 0, 5, settings, Workers(2));
    CHECK(test::digest_of(*one) == test::digest_of(*two));
  }
}

TEST_CASE("the same bytes on every instruction set") {
  std::vector<std::string> digests;
  test::on_every_target([&] { digests.push_back(test::digest_of(*test::box_map(test::empty_grid(0.04), 0, 5))); });
  REQUIRE_FALSE(digests.empty());
  for (const auto& digest : digests) CHECK(digest == digests[0]);
}

TEST_CASE("free space costs no leaves, and settles at the clamp") {
  const Pose pose = Pose::Identity();
  Frame wall = test::plane_image({64, 64, 60, 60, 31.5, 31.5}, {0, 0, 1}, 2.0);
  auto map = test::empty_grid(0.02, -2, 3);
  map = test::after(std::move(map), wall, pose);
  for (int i = 0; i < 40; ++i) map = test::after(std::move(map), wall, pose);
  VdbReader reader(*map);
  const auto leaf = reader.leaf(0, 0, 50);
  CHECK(leaf.codes == nullptr);
  CHECK(leaf.constant == map->code(-2));
  CHECK(reader(0, 0, 120) == kVdbUnknown);
  const auto same = test::after(map, wall, pose);
  std::size_t written = 0;
  for (std::size_t i = 0; i < map->table().size(); ++i) written += !(same->table()[i].tile == map->table()[i].tile);
  CHECK(written < map->table().size() / 4);  // what is clamped stays shared
}

TEST_CASE("a frame without measurements, or that looks away, changes nothing") {
  const auto map = test::box_map(test::empty_grid(0.05), 0, 3);
  Frame blind = test::box_image(test::pose_in_box(0));
  blind.depth.assign(blind.depth.size(), test::kNoReturn);
  CHECK(test::digest_of(*test::after(map, blind, test::pose_in_box(0))) == test::digest_of(*map));
}

TEST_CASE("what was mapped and left is free again") {
  const Pose pose = Pose::Identity();
  const Camera camera{64, 64, 60, 60, 31.5, 31.5};
  auto map = test::empty_grid(0.02, -10, 20);
  for (int i = 0; i < 100; ++i) map = test::after(std::move(map), test::plane_image(camera, {0, 0, 1}, 1.0), pose);
  CHECK(*map->log_odds({0, 0, 50}) > 1);
  int frames = 0;
  for (; *map->log_odds({0, 0, 50}) > 0; ++frames)
    map = test::after(std::move(map), test::plane_image(camera, {0, 0, 1}, 2.0), pose);
  CHECK(frames < 60);
  CHECK(*map->log_odds({0, 0, 100}) > 0);
}
