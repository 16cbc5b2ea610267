// OctoMap as an oracle for `model: literal`: the same rays, hits, misses and clamps.
#include <catch2/catch.hpp>
#include <octomap/OcTree.h>

#include "modules/maps/vdb/vdb_reader.hpp"
#include "tests/occupancy/occupancy_world.hpp"

using namespace ppm;

namespace {

octomap::point3d point(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

void insert(octomap::OcTree& tree, const Frame& frame, const Pose& T_map_camera, double max_range_m) {
  octomap::Pointcloud cloud;
  for (int i = 0; i < frame.camera.pixels(); ++i)
    if (frame.valid(i))
      cloud.push_back(point(T_map_camera * (frame.depth[static_cast<std::size_t>(i)] *
                                            frame.camera.ray(i % frame.camera.cols, i / frame.camera.cols))));
  tree.insertPointCloud(cloud, point(T_map_camera.translation()), max_range_m);
}

}  // namespace

TEST_CASE("rays, hits and misses are OctoMap's") {
  constexpr double kVoxel = 0.05;
  OccupancySettings settings;
  settings.form = OccupancyForm::literal;
  settings.memory = 0;
  settings.max_range_m = GENERATE(100.0, 1.1);
  octomap::OcTree tree(kVoxel);
  auto map = test::empty_grid(kVoxel, tree.getClampingThresMinLog(), tree.getClampingThresMaxLog());
  settings.log_odds_hit = tree.getProbHitLog();
  settings.log_odds_miss = tree.getProbMissLog();
  for (int i = 0; i < 20; ++i) {
    const Pose pose = test::pose_in_box(i);
    const Frame frame = test::box_image(pose);
    map = test::after(std::move(map), frame, pose, settings);
    insert(tree, frame, pose, settings.max_range_m);
  }
  VdbReader reader(*map);
  int known = 0, differ = 0, occupied = 0, occupied_differ = 0;
  for (int x = -24; x < 24; ++x)
    for (int y = -24; y < 24; ++y)
      for (int z = -24; z < 24; ++z) {
        const VdbCode code = reader(x, y, z);
        const auto* node = tree.search(point(kVoxel * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5)));
        if (!node && code == kVdbUnknown) continue;
        ++known;
        const bool one_sided = !node || code == kVdbUnknown;
        differ += one_sided || std::abs(code * map->step() - node->getLogOdds()) > 0.01;
        occupied += node && node->getLogOdds() > 0;
        occupied_differ += one_sided || (code > 0) != (node->getLogOdds() > 0);
      }
  REQUIRE(known > 30000);
  REQUIRE(occupied > 300);
  // OctoMap keeps points in single precision: what lies within that of a voxel's face falls on either side.
  CHECK(differ < known / 500);
  CHECK(occupied_differ < occupied / 500);
}
