#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/builtin.hpp"

using namespace ppm;

TEST_CASE("a frame of the room is the same bytes however it is read") {
  Registry registry;
  register_builtin(registry);
  Harness h(registry, "source.synthetic_room", "{frames: 4}");
  for (int i = 0; i < 4; ++i) REQUIRE(h.tick());
  auto last = h.output<Frame>("frame");
  CHECK_FALSE(h.tick());
  const Frame again = static_cast<FrameSource&>(h.module()).full_frame(3);
  CHECK(std::memcmp(again.depth.data(), last->depth.data(), again.depth.size() * sizeof(float)) == 0);
  CHECK(std::memcmp(again.sigma.data(), last->sigma.data(), again.sigma.size() * sizeof(float)) == 0);
}
