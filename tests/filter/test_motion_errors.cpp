#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/so3.hpp"
#include "framework/roles/motion_errors.hpp"
#include "tests/support/imu_world.hpp"
#include "tests/support/registry.hpp"

namespace {

using ppm::Frame;
using ppm::Pose;

Frame frame_at(int k, const Pose& T_world_camera) {
  Frame f;
  f.index = k;
  f.stamp_s = 0.1 * k;
  f.T_world_camera_ref = T_world_camera;
  return f;
}

ppm::Twist normal6(ppm::Rng& rng, double sigma_t, double sigma_r) {
  ppm::Twist e;
  e << ppm::test::normal3(rng, sigma_t), ppm::test::normal3(rng, sigma_r);
  return e;
}

/// A random walk of given noise.
std::vector<Frame> walk(int n, double sigma_t, double sigma_r) {
  ppm::Rng rng(1, 0, 0, 0);
  Pose T = Pose::Identity();
  std::vector<Frame> frames;
  for (int k = 0; k < n; ++k) {
    frames.push_back(frame_at(k, T));
    T = T * ppm::se3_exp(normal6(rng, sigma_t, sigma_r));
  }
  return frames;
}

}  // namespace

TEST_CASE("a random walk's errors are its noise, and its expectation is consistent where the noise is right") {
  const auto frames = walk(3003, 0.02, 0.01);
  const auto at = [&](const std::string& params) {
    return summary(ppm::motion_errors(ppm::test::builtin(), "motion.random_walk", params, frames));
  };
  const auto right = at("{sigma_t: 2 cm, sigma_r: 10 mrad}");
  CHECK(right.steps == 3000);
  CHECK(right.sigma_t == Approx(0.02).epsilon(0.03));
  CHECK(right.sigma_r == Approx(0.01).epsilon(0.03));
  CHECK(right.rms[1] == Approx(0.02).epsilon(0.06));
  CHECK(right.translation_95 == Approx(0.02 * 2.795).epsilon(0.05));  // of a chi of 3 degrees
  CHECK(right.consistency == Approx(1).epsilon(0.05));
  CHECK(at("{sigma_t: 4 cm, sigma_r: 20 mrad}").consistency == Approx(0.25).epsilon(0.05));
  CHECK(at("{noise_steps: 50, sigma_t: 4 cm, sigma_r: 20 mrad, noise_prior: 0.01}").consistency == Approx(1).epsilon(0.1));
}

TEST_CASE("every n-th frame carries the inertial samples of all the way") {
  std::vector<Frame> frames = walk(8, 0.01, 0.01);
  for (auto& f : frames) {
    f.imu.resize(2);
    f.imu[0].stamp_s = f.stamp_s - 0.05;
    f.imu[1].stamp_s = f.stamp_s;
  }
  const auto third = ppm::every_nth(frames, 3, 1);
  REQUIRE(third.size() == 3);
  CHECK(third[0].index == 1);
  CHECK(third[1].index == 4);
  REQUIRE(third[1].imu.size() == 6);
  CHECK(third[1].imu.front().stamp_s == Approx(0.15));
  CHECK(third[2].index == 7);
  CHECK(third[2].imu.back().stamp_s == Approx(0.7));
}

TEST_CASE("odometry's growing noise is found again") {
  ppm::Rng rng(2, 0, 0, 0);
  std::vector<Frame> frames;
  Pose T_world_base = Pose::Identity(), T_odom_base = Pose::Identity();
  ppm::Twist lever;
  lever << 0.1, 0, 0.3, 0, 1, 0;
  for (int k = 0; k < 6000; ++k) {
    Frame f = frame_at(k, T_world_base * ppm::se3_exp(lever));
    f.T_base_camera = ppm::se3_exp(lever);
    f.T_odom_base = T_odom_base;
    frames.push_back(f);
    ppm::Twist step = ppm::Twist::Zero();
    step[0] = 0.3 * rng.uniform();
    step[5] = 0.4 * rng.uniform();
    T_world_base = T_world_base * ppm::se3_exp(step);
    const double t = 0.002 + 0.05 * step[0] + 0.02 * step[5], r = 0.001 + 0.03 * step[5];
    T_odom_base = T_odom_base * ppm::se3_exp(step) * ppm::se3_exp(normal6(rng, t, r));
  }
  const auto errors = ppm::motion_errors(ppm::test::builtin(), "motion.odometry", "{}", frames);
  const auto t = fit_growing_noise(errors, false), r = fit_growing_noise(errors, true);
  CHECK(t.least == Approx(0.002).margin(0.0006));
  CHECK(t.per_m == Approx(0.05).epsilon(0.08));
  CHECK(t.per_rad == Approx(0.02).epsilon(0.12));
  CHECK(r.least == Approx(0.001).margin(0.0004));
  CHECK(r.per_m == Approx(0).margin(0.002));
  CHECK(r.per_rad == Approx(0.03).epsilon(0.06));
}

TEST_CASE("the noise of an inertial unit is found again as what makes its path likeliest") {
  const ppm::test::SwingingBody body;
  ppm::test::NoisyImu imu{{3e-3, 3e-2, 1e-5, 1e-4}, {}, ppm::Rng(1, 0, 0, 0)};
  ppm::Rng rng(2, 0, 0, 0);
  std::vector<Frame> frames;
  for (int k = 0; k < 300; ++k) {
    Frame f = frame_at(k, body.pose(0.1 * k) * ppm::se3_exp(normal6(rng, 1e-3, 5e-4)));
    for (const auto& exact : body.samples(0.1 * (k - 1), 0.1 * k, 0.01)) f.imu.push_back(imu.measure(exact, 0.01));
    frames.push_back(f);
  }
  const auto start = ppm::parse_yaml("{gyro_noise: 1e-3, accel_noise: 0.1, sigma_t: 0.01, sigma_r: 0.01, gyro_walk: 1e-5, accel_walk: 1e-4}", "test");
  const auto fitted =
      ppm::likeliest(ppm::test::builtin(), "motion.imu", start, {"gyro_noise", "accel_noise", "sigma_t", "sigma_r"}, frames);
  CHECK(std::stod(fitted.find("gyro_noise")->text()) == Approx(3e-3).epsilon(0.25));
  CHECK(std::stod(fitted.find("accel_noise")->text()) == Approx(3e-2).epsilon(0.4));
  CHECK(std::stod(fitted.find("sigma_t")->text()) == Approx(1e-3).epsilon(0.25));
  CHECK(std::stod(fitted.find("sigma_r")->text()) == Approx(5e-4).epsilon(0.4));
}
