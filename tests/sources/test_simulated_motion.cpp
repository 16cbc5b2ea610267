#include <catch2/catch.hpp>
#include <cmath>

#include "modules/sources/house_plans.hpp"
#include "modules/sources/mesh_sequence.hpp"
#include "modules/sources/simulated_imu.hpp"
#include "modules/sources/simulated_odometry.hpp"
#include "tests/sources/ply_files.hpp"
#include "tests/sources/source_reader.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

SimulatedImu exact_imu() {
  SimulatedImu imu;
  imu.gyro_noise = imu.accel_noise = imu.gyro_walk = imu.accel_walk = imu.gyro_bias = imu.accel_bias = 0;
  return imu;
}

/// A camera that stands still and looks along +x.
CameraPath still(double seconds) {
  Gait gait;
  gait.sway = 0;
  return CameraPath({{{0, 0, 1}, 0, 0, {}, false}, {{0, 0, 1}, 0, 0, seconds, false}}, gait);
}

}  // namespace

TEST_CASE("a camera at rest feels gravity along its upward axis, which is -y") {
  const auto samples = exact_imu().samples(still(1), 1, 1);
  REQUIRE(samples.size() == 401);
  CHECK(samples.front().stamp_s == Approx(-1));
  for (const ImuSample& s : {samples.front(), samples[300]}) {
    CHECK(s.gyro.norm() < 1e-12);
    CHECK(s.accel.isApprox(Eigen::Vector3d(0, -9.80665, 0)));
  }
}

TEST_CASE("exact inertial samples lead along the path") {
  const CameraPath path(house_plan(HousePlan::loop), {});
  SimulatedImu imu = exact_imu();
  imu.rate_Hz = 1000;
  const auto samples = imu.samples(path, 10, 1);
  const double dt = 1 / imu.rate_Hz;
  const CameraMotion start = path.at(0);
  Eigen::Matrix3d R = start.T_world_camera.linear();
  Eigen::Vector3d v = start.velocity_world, p = start.T_world_camera.translation();
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    if (samples[k].stamp_s < -1e-9) continue;
    const Eigen::Vector3d turn = 0.5 * dt * (samples[k].gyro + samples[k + 1].gyro);
    const Eigen::Matrix3d next = R * se3_exp((Twist() << 0, 0, 0, turn).finished()).linear();
    const Eigen::Vector3d a = 0.5 * (R * samples[k].accel + next * samples[k + 1].accel) - Eigen::Vector3d(0, 0, 9.80665);
    p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    R = next;
  }
  const Pose end = path.at(samples.back().stamp_s).T_world_camera;
  CHECK((p - end.translation()).norm() < 1e-3);
  CHECK((R.transpose() * end.linear() - Eigen::Matrix3d::Identity()).norm() < 1e-4);
}

TEST_CASE("inertial noise has its densities, and biases walk") {
  SimulatedImu imu = exact_imu();
  imu.gyro_noise = 1e-3;
  imu.accel_walk = 1e-2;
  const double seconds = 100;
  const auto samples = imu.samples(still(seconds), seconds, 3);
  double gyro = 0, steps = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    gyro += samples[k].gyro.squaredNorm();
    steps += (samples[k].accel - samples[k - 1].accel).squaredNorm();
  }
  const double n = 3.0 * static_cast<double>(samples.size() - 1);
  CHECK(std::sqrt(gyro / n) == Approx(1e-3 * std::sqrt(imu.rate_Hz)).epsilon(0.02));
  CHECK(std::sqrt(steps / n) == Approx(1e-2 / std::sqrt(imu.rate_Hz)).epsilon(0.02));
  imu.gyro_bias = 0.1;
  const auto a = imu.samples(still(1), 1, 1), b = imu.samples(still(1), 1, 2);
  CHECK((a[0].gyro - b[0].gyro).norm() > 0.02);
  CHECK(a[7].accel == imu.samples(still(1), 1, 1)[7].accel);
}

TEST_CASE("odometry without noise is the path from its first pose on") {
  const auto path = sampled(CameraPath(house_plan(HousePlan::loop), {}), 10, 200);
  SimulatedOdometry odometry;
  odometry.t_per_m = odometry.t_per_rad = odometry.r_per_m = odometry.r_per_rad = 0;
  const auto poses = odometry.poses(path, {}, 1);
  for (std::size_t i : {0, 50, 199})
    CHECK(poses[i].isApprox(path[0].T_map_camera.inverse() * path[i].T_map_camera, 1e-9));
}

TEST_CASE("odometry drifts with the way, and feels no jump") {
  const CameraPath kidnap(house_plan(HousePlan::kidnap), {});
  const auto path = sampled(kidnap, 10, -1);
  const SimulatedOdometry odometry;
  const auto poses = odometry.poses(path, kidnap.jumps_s(), 1);
  for (std::size_t i = 1; i < poses.size(); ++i) CHECK((poses[i - 1].inverse() * poses[i]).translation().norm() < 0.15);
  const auto loop = sampled(CameraPath(house_plan(HousePlan::loop), {}), 10, -1);
  const auto drift = [&](std::uint64_t seed) {
    const auto drifted = odometry.poses(loop, {}, seed);
    return (loop[0].T_map_camera.inverse() * loop.back().T_map_camera * drifted.back().inverse()).translation().norm();
  };
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) sum += drift(seed);
  CHECK(sum / 5 > 0.1);
  CHECK(sum / 5 < 3);
}

TEST_CASE("frames of a mesh carry what was measured since the frame before") {
  const TempFolder folder;
  write_text(folder / "squares.ply", two_squares());
  write_text(folder / "way.txt", "0 0 1 0 0\n0 0.5 1 10 0\n");
  SourceReader reader("source.mesh_scene", "{file: " + (folder / "squares.ply").string() + ", waypoints: " +
                                               (folder / "way.txt").string() + ", imu: true, odometry: true, stride: 2}");
  const auto first = reader.next(), second = reader.next();
  REQUIRE(first->imu.size() == 201);
  CHECK(first->imu.back().stamp_s == 0);
  REQUIRE(second->imu.size() == 40);
  CHECK(second->imu.front().stamp_s == Approx(0.005));
  CHECK(second->imu.back().stamp_s == Approx(0.2));
  CHECK(first->T_odom_base->isApprox(Pose::Identity()));
  const Pose step = first->T_world_camera_ref->inverse() * *second->T_world_camera_ref;
  CHECK((step.inverse() * *second->T_odom_base).translation().norm() < 0.2 * step.translation().norm() + 0.01);
  const auto bare = SourceReader("source.mesh_scene", "{file: " + (folder / "squares.ply").string() + ", waypoints: " +
                                                          (folder / "way.txt").string() + "}")
                        .next();
  CHECK(bare->imu.empty());
  CHECK_FALSE(bare->T_odom_base);
}
