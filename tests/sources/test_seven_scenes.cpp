#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/builtin.hpp"
#include "tests/support/data.hpp"

using namespace ppm;

TEST_CASE("the kitchen gives frames with depth, sigma and reference pose") {
  auto kitchen = test::data_path("kitchen");
  if (!kitchen) return;
  Registry registry;
  register_builtin(registry);
  Harness h(registry, "source.seven_scenes", "{path: \"" + kitchen->string() + "\", first: 3}");
  REQUIRE(h.tick());
  auto frame = h.output<Frame>("frame");
  CHECK(frame->index == 3);
  CHECK(frame->stamp_s == Approx(0.1));
  CHECK(frame->camera == Camera{320, 240, 292.5, 292.5, 160, 120});
  CHECK(frame->depth.size() == 320 * 240);
  CHECK(frame->T_world_camera_ref);
}
