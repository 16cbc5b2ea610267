#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

TEST_CASE("map.ppm_empty starts all particles on one empty map at the reference pose") {
  const Registry& registry = test::builtin();
  Harness h(registry, "map.ppm_empty", "{particles: 7, cell_size: 50 cm, texel_size: 1 cm, prior_sigma: 3 cm}");
  auto frame = std::make_shared<Frame>();
  frame->index = 42;
  frame->stamp_s = 1.5;
  frame->T_world_camera_ref = Pose(Eigen::Translation3d(1, 2, 3));
  h.input<Frame>("frame", frame);
  h.tick();
  const auto& belief = h.belief();
  REQUIRE(belief.size() == 7);
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(belief.pose[i].translation() == Eigen::Vector3d(1, 2, 3));
    CHECK(belief.trajectory[i].length() == 1);
    CHECK(belief.trajectory[i].last().frame == 42);
    CHECK(belief.map[i] == belief.map[0]);
  }
  CHECK(belief.ess() == Approx(7));
  const auto& map = dynamic_cast<const PpmMap&>(*belief.map[0]);
  CHECK(map.stats().faces == 0);
  CHECK(map.settings().cell_size_m == 0.5);
  CHECK(map.settings().texel_size_m == 0.01);
  CHECK(map.settings().prior_sigma_m == 0.03);
}

TEST_CASE("map.ppm_empty at identity needs no reference, and without one it refuses to start there") {
  const Registry& registry = test::builtin();
  auto frame = std::make_shared<Frame>();
  frame->index = 8;
  Harness at_identity(registry, "map.ppm_empty", "{particles: 2, start: identity}");
  at_identity.input<Frame>("frame", frame);
  at_identity.tick();
  CHECK(at_identity.belief().pose[1].isApprox(Pose::Identity()));
  Harness at_reference(registry, "map.ppm_empty", "{start: reference}");
  at_reference.input<Frame>("frame", frame);
  CHECK_THROWS_WITH(at_reference.tick(), Catch::Contains("8") && Catch::Contains("start: identity"));
}
