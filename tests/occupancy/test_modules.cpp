#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "tests/occupancy/occupancy_world.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

const VdbMap& grid(const Harness& h, std::size_t particle) {
  return static_cast<const VdbMap&>(*const_cast<Harness&>(h).belief().map[particle]);
}

std::shared_ptr<Frame> frame_at(int number) {
  auto frame = std::make_shared<Frame>(test::box_image(test::pose_in_box(number)));
  frame->T_world_camera_ref = test::pose_in_box(number);
  return frame;
}

}  // namespace

TEST_CASE("map.vdb_empty starts all particles on one empty grid") {
  Harness h(test::builtin(), "map.vdb_empty",
            "{particles: 3, voxel_size: 3 cm, log_odds_min: -2, log_odds_max: 3.5}");
  h.input<Frame>("frame", frame_at(0));
  h.tick();
  REQUIRE(h.belief().size() == 3);
  CHECK(h.belief().map[2] == h.belief().map[0]);
  CHECK(grid(h, 0).settings().voxel_size_m == 0.03);
  CHECK(grid(h, 0).settings().log_odds_min == -2);
  CHECK(grid(h, 0).settings().log_odds_max == 3.5);
  CHECK(grid(h, 0).stats().chunks == 0);
  CHECK_THROWS_AS(Harness(test::builtin(), "map.vdb_empty", "{voxel_size: 0}"), ConfigError);
  CHECK_THROWS_AS(Harness(test::builtin(), "map.vdb_empty", "{log_odds_min: 1}"), ConfigError);
}

TEST_CASE("map_update.vdb_occupancy writes each particle's view into its grid, and held-out frames into none") {
  Harness h(test::builtin(), "map_update.vdb_occupancy", "{model: profile, keyframe_misses: 1}");
  h.belief().init(2, test::pose_in_box(0), test::empty_grid(0.05));
  h.belief().pose[1] = test::pose_in_box(1);
  auto held_out = frame_at(0);
  held_out->held_out = true;
  h.input<Frame>("frame", held_out);
  h.tick();
  CHECK(grid(h, 0).stats().chunks == 0);
  const auto frame = frame_at(0);
  h.input<Frame>("frame", frame);
  h.tick();
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(test::digest_of(grid(h, i)) ==
          test::digest_of(*test::after(test::empty_grid(0.05), *frame, test::pose_in_box(static_cast<int>(i)))));
  CHECK_THROWS_AS(Harness(test::builtin(), "map_update.vdb_occupancy", "{model: exact}"), ConfigError);
  CHECK_THROWS_AS(Harness(test::builtin(), "map_update.vdb_occupancy", "{hit: 0.4}"), ConfigError);
}
