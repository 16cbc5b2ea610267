// What sink.rawlog records, source.rawlog gives again.
#include <catch2/catch.hpp>
#include <fstream>
#include <limits>
#include <sstream>

#include "framework/core/error.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using ppm::Frame;
using ppm::Pose;
using ppm::test::TempFolder;

Pose pose(double a) {
  ppm::Twist xi;
  xi << 0.3 * a, 1 - a, 0.1, 0.4, 0.2 * a, -0.7;
  return ppm::se3_exp(xi);
}

Frame frame_at(int k) {
  Frame f;
  f.index = k;
  f.stamp_s = 12.3 + 0.1 * k;
  f.camera = {5, 4, 100.5, -101.25, 2.1, 1.4};
  f.T_base_camera = pose(0.5);
  f.T_odom_base = pose(k);
  f.T_world_camera_ref = pose(-k);
  for (int i = 0; i < 20; ++i) {
    f.depth.push_back(i == 7 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>((1000 + 37 * i + k) / 1000.0));
    for (int c = 0; c < 3; ++c) f.color.push_back(static_cast<std::uint8_t>(10 * i + c + k));
  }
  f.sigma.assign(20, 0.01f);
  for (int j = 1; j <= 4; ++j)
    f.imu.push_back({f.stamp_s - 0.1 + 0.025 * j, Eigen::Vector3d(0.1, 0.2 * k, j), Eigen::Vector3d(k, 9.8, 0.01 * j)});
  return f;
}

void record(ppm::Harness& sink, int from, int to) {
  for (int k = from; k < to; ++k) {
    sink.input<Frame>("frame", std::make_shared<const Frame>(frame_at(k)));
    sink.tick();
  }
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("frames come back from a rawlog as they were: depth, colour, times, lens, inertial samples and poses") {
  const bool compress = GENERATE(true, false);
  TempFolder folder;
  ppm::Harness sink(ppm::test::builtin(), "sink.rawlog", compress ? "{}" : "{compress: false}", 1, 1, folder / "");
  record(sink, 0, 5);
  CHECK(std::filesystem::exists(folder / "frames.rawlog.part"));
  sink.close();
  CHECK_FALSE(std::filesystem::exists(folder / "frames.rawlog.part"));
  ppm::Harness source(ppm::test::builtin(), "source.rawlog",
                      "{color: true, path: " + (folder / "frames.rawlog").string() + "}");
  for (int k = 0; k < 5; ++k) {
    REQUIRE(source.tick());
    const auto back = source.output<Frame>("frame");
    const Frame was = frame_at(k);
    CHECK(back->index == k);
    CHECK(back->stamp_s == Approx(was.stamp_s).margin(1e-7));
    CHECK(back->camera == was.camera);
    CHECK(back->T_base_camera.isApprox(was.T_base_camera, 1e-12));
    CHECK(back->T_odom_base->isApprox(*was.T_odom_base, 1e-12));
    CHECK(back->T_world_camera_ref->isApprox(*was.T_world_camera_ref, 1e-12));
    CHECK(back->color == was.color);
    REQUIRE(back->imu.size() == 4);
    for (std::size_t j = 0; j < 4; ++j) {
      CHECK(back->imu[j].stamp_s == Approx(was.imu[j].stamp_s).margin(1e-7));
      CHECK(back->imu[j].gyro == was.imu[j].gyro);
      CHECK(back->imu[j].accel == was.imu[j].accel);
    }
    REQUIRE(back->depth.size() == 20);
    for (int i = 0; i < 20; ++i) {
      REQUIRE(back->valid(i) == was.valid(i));
      if (was.valid(i)) CHECK(back->depth[static_cast<std::size_t>(i)] == was.depth[static_cast<std::size_t>(i)]);
    }
  }
  CHECK_FALSE(source.tick());
}

TEST_CASE("a recording that is stopped and goes on is the same file, whether the run was killed or ended in order") {
  TempFolder whole, stopped;
  ppm::Harness once(ppm::test::builtin(), "sink.rawlog", "{}", 1, 1, whole / "");
  record(once, 0, 6);
  once.close();
  const bool in_order = GENERATE(true, false);
  std::string state;
  {
    ppm::Harness first(ppm::test::builtin(), "sink.rawlog", "{}", 1, 1, stopped / "");
    record(first, 0, 3);
    state = first.save();
    record(first, 3, 5);  // beyond the checkpoint
    if (in_order) first.close();
  }
  ppm::Harness second(ppm::test::builtin(), "sink.rawlog", "{}", 1, 1, stopped / "");
  second.load(state, 3);
  record(second, 3, 6);
  second.close();
  CHECK(bytes_of(stopped / "frames.rawlog") == bytes_of(whole / "frames.rawlog"));
  std::filesystem::remove(stopped / "frames.rawlog");
  ppm::Harness third(ppm::test::builtin(), "sink.rawlog", "{}", 1, 1, stopped / "");
  CHECK_THROWS_WITH(third.load(state, 3), Contains("not there any more"));
}

TEST_CASE("depths that do not fit the unit are refused") {
  TempFolder folder;
  ppm::Harness sink(ppm::test::builtin(), "sink.rawlog", "{range_unit: 0.01 mm}", 1, 1, folder / "");
  sink.input<Frame>("frame", std::make_shared<const Frame>(frame_at(3)));
  CHECK_THROWS_WITH(sink.tick(), Contains("frame 3") && Contains("does not fit"));
}
