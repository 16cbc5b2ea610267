#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/sources/camera_path.hpp"
#include "modules/sources/waypoint_file.hpp"
#include "tests/sources/ply_files.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

Waypoint at(double x, double y, double yaw, double pitch = 0) {
  return {{x, y, 1.4}, yaw, pitch, {}, false};
}

std::vector<Waypoint> zigzag() {
  return {at(0, 0, 0), at(1, 0, 0.5, -0.2), at(1, 2, 2), at(-1, 2.5, 2.2, 0.3), at(-2, 0, 5)};
}

std::string error_of(const std::string& text) {
  const TempFolder folder;
  write_text(folder / "way.txt", text);
  try {
    read_waypoints(folder / "way.txt");
  } catch (const DataError& e) {
    const std::string what = e.what();
    return what.substr(what.find("way.txt"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("a path goes through its waypoints, looks as they say and rests at its ends") {
  const auto way = zigzag();
  Gait gait;
  gait.sway = 0;
  const CameraPath path(way, gait);
  const CameraMotion begin = path.at(0), end = path.at(path.duration_s());
  CHECK(begin.T_world_camera.translation().isApprox(way[0].position));
  CHECK(end.T_world_camera.translation().isApprox(way[4].position));
  CHECK(begin.T_world_camera.linear().col(2).isApprox(Eigen::Vector3d::UnitX()));
  CHECK(begin.T_world_camera.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ()));
  CHECK(end.T_world_camera.linear().col(2).isApprox(Eigen::Vector3d(std::cos(5), std::sin(5), 0)));
  for (const CameraMotion& m : {begin, end}) {
    CHECK(m.velocity_world.norm() < 1e-9);
    CHECK(m.angular_velocity.norm() < 1e-9);
  }
  const double second_s = 1 / gait.speed, third_s = 2 / gait.speed;
  CHECK(path.at(second_s).T_world_camera.translation().isApprox(way[1].position));
  CHECK(path.at(second_s + third_s).T_world_camera.translation().isApprox(way[2].position, 1e-3));
}

TEST_CASE("the derivatives of a path are those of its poses") {
  const CameraPath path(zigzag(), {});
  const double h = 1e-4;
  for (double t = 0.05; t < path.duration_s() - 0.05; t += 0.173) {
    const CameraMotion a = path.at(t - h), m = path.at(t), b = path.at(t + h);
    const Eigen::Vector3d velocity = (b.T_world_camera.translation() - a.T_world_camera.translation()) / (2 * h);
    const Eigen::Vector3d acceleration = (b.velocity_world - a.velocity_world) / (2 * h);
    const Eigen::Matrix3d turned = a.T_world_camera.linear().transpose() * b.T_world_camera.linear();
    const Eigen::AngleAxisd rotation(turned);
    INFO("t " << t);
    CHECK((m.velocity_world - velocity).norm() < 1e-5);
    CHECK((m.acceleration_world - acceleration).norm() < 1e-3);
    CHECK((m.angular_velocity - rotation.angle() * rotation.axis() / (2 * h)).norm() < 1e-5);
  }
}

TEST_CASE("a fast turn hardly overshoots") {
  auto way = zigzag();
  way[2].seconds = 0.3;
  Gait gait;
  gait.sway = 0;
  const CameraPath path(way, gait);
  double most = 0;
  for (double t = 0; t <= path.duration_s(); t += 0.01) {
    const Eigen::Vector3d forward = path.at(t).T_world_camera.linear().col(2);
    double yaw = std::atan2(forward.y(), forward.x());
    while (yaw < most - 3) yaw += 2 * EIGEN_PI;
    CHECK(yaw > most - 0.01);
    most = std::max(most, yaw);
  }
}

TEST_CASE("a jump takes no time") {
  auto way = zigzag();
  way[3].jump = true;
  Gait gait;
  gait.sway = 0;
  const CameraPath path(way, gait);
  REQUIRE(path.jumps_s().size() == 1);
  const double t = path.jumps_s()[0];
  CHECK(path.at(t - 1e-9).T_world_camera.translation().isApprox(way[2].position));
  CHECK(path.at(t).T_world_camera.translation().isApprox(way[3].position));
  way[4].jump = true;
  CHECK_THROWS_AS(CameraPath(way, gait), InternalError);
}

TEST_CASE("waypoints are read from a file") {
  const TempFolder folder;
  write_text(folder / "way.txt", "# a way\n0 0 1.4 90 -10\n1 0 1.4 180 0 2.5  # slowly\njump\n5 5 1 0 0\n\n6 5 1 0 0\n");
  const auto way = read_waypoints(folder / "way.txt");
  REQUIRE(way.size() == 4);
  CHECK(way[0].yaw == Approx(EIGEN_PI / 2));
  CHECK_FALSE(way[0].seconds);
  CHECK(*way[1].seconds == 2.5);
  CHECK_FALSE(way[1].jump);
  CHECK(way[2].jump);
  CHECK(way[3].position.isApprox(Eigen::Vector3d(6, 5, 1)));
}

TEST_CASE("what is wrong with waypoints is said with its line") {
  const std::string two = "0 0 1 0 0\n1 0 1 0 0\n";
  CHECK(error_of(two + "1 2 3\n") == "way.txt:3:1: a waypoint has the form 'x y z yaw pitch [seconds]'");
  CHECK(error_of(two + "1 2 x 0 0\n") == "way.txt:3:1: 'x' is no finite number");
  CHECK(error_of(two + "1 2 3 0 0 0\n") == "way.txt:3:1: the seconds since the waypoint before are not positive");
  CHECK(error_of(two + "jump\n1 2 3 0 0\n") == "way.txt:5:1: 1 waypoints before the end; a way needs two");
  CHECK(error_of("jump\n" + two) == "way.txt:1:1: 0 waypoints before a jump; a way needs two");
  CHECK_THROWS_AS(read_waypoints("no/such/file"), DataError);
}
