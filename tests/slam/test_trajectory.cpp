#include <catch2/catch.hpp>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/slam/trajectory.hpp"

namespace {

ppm::StampedPose at(std::int64_t frame) {
  ppm::StampedPose p;
  p.frame = frame;
  p.T_map_camera.translation().x() = static_cast<double>(frame);
  return p;
}

std::vector<std::int64_t> frames(const ppm::Trajectory& t) {
  std::vector<std::int64_t> out;
  for (const auto& p : t.poses()) out.push_back(p.frame);
  return out;
}

}  // namespace

TEST_CASE("a trajectory gives its poses oldest first") {
  ppm::Trajectory t;
  CHECK(t.empty());
  CHECK(t.poses().empty());
  for (int i = 0; i < 3; ++i) t.extend(at(i));
  CHECK(t.length() == 3);
  CHECK(t.last().frame == 2);
  CHECK(frames(t) == std::vector<std::int64_t>{0, 1, 2});
}

TEST_CASE("extending a copy leaves its sibling and their parent alone") {
  ppm::Trajectory trunk;
  trunk.extend(at(0));
  trunk.extend(at(1));
  ppm::Trajectory a = trunk, b = trunk;
  CHECK(a == b);
  a.extend(at(10));
  b.extend(at(20));
  b.extend(at(21));
  CHECK(frames(trunk) == std::vector<std::int64_t>{0, 1});
  CHECK(frames(a) == std::vector<std::int64_t>{0, 1, 10});
  CHECK(frames(b) == std::vector<std::int64_t>{0, 1, 20, 21});
  CHECK(a.parent() == trunk);
  trunk = ppm::Trajectory();
  b = a;
  CHECK(frames(b) == std::vector<std::int64_t>{0, 1, 10});
}

TEST_CASE("a trajectory survives assignment to itself and being moved from") {
  ppm::Trajectory t;
  t.extend(at(0));
  const auto& alias = t;
  t = alias;
  CHECK(frames(t) == std::vector<std::int64_t>{0});
  ppm::Trajectory moved = std::move(t);
  CHECK(frames(moved) == std::vector<std::int64_t>{0});
  CHECK(moved.parent().empty());
  CHECK_THROWS_AS(moved.parent().parent(), ppm::InternalError);
}

TEST_CASE("a path of a million poses is freed without recursion") {
  ppm::Trajectory trunk;
  for (int i = 0; i < 500'000; ++i) trunk.extend(at(i));
  ppm::Trajectory branch = trunk;
  for (int i = 500'000; i < 1'000'000; ++i) branch.extend(at(i));
  trunk = ppm::Trajectory();
  CHECK(branch.length() == 1'000'000);
  CHECK(branch.poses()[123'456].frame == 123'456);
  branch = ppm::Trajectory();
  CHECK(branch.empty());
}
