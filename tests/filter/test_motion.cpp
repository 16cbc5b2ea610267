#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/motion_prior.hpp"
#include "tests/support/registry.hpp"

namespace {

using ppm::Pose;
using ppm::Twist;

std::shared_ptr<const ppm::Frame> frame_at(std::int64_t index, double stamp_s, std::optional<Pose> reference = {}) {
  auto frame = std::make_shared<ppm::Frame>();
  frame->index = index;
  frame->stamp_s = stamp_s;
  frame->T_world_camera_ref = reference;
  return frame;
}

double distance(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

Twist some_twist() {
  Twist xi;
  xi << 0.03, -0.01, 0.05, 0.02, 0.04, -0.03;
  return xi;
}

/// n particles with the path exp(0), exp(xi) at 0 s and 0.1 s.
void begin(ppm::ParticleSet& belief, std::size_t n, const Twist& xi) {
  belief.init(n, Pose::Identity(), nullptr);
  for (std::size_t i = 0; i < n; ++i) {
    belief.extend(i, {0, 0.0, Pose::Identity()});
    belief.extend(i, {1, 0.1, ppm::se3_exp(xi)});
  }
}

}  // namespace

TEST_CASE("without noise, constant velocity stays on a path of constant velocity, over skipped frames too") {
  ppm::Harness h(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 0, sigma_r: 0}");
  begin(h.belief(), 2, some_twist());
  for (double steps : {2.0, 3.0, 5.0, 5.5, 9.0}) {  // frames 4 and 6 to 8 are missing, 5.5 is between two
    h.input<ppm::Frame>("frame", frame_at(static_cast<std::int64_t>(10 * steps), 0.1 * steps));
    h.tick();
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(distance(h.belief().pose[i], ppm::se3_exp(steps * some_twist())) < 1e-9);
      CHECK(h.belief().trajectory[i].last().stamp_s == 0.1 * steps);
      CHECK(h.belief().trajectory[i].last().frame == static_cast<std::int64_t>(10 * steps));
    }
  }
}

TEST_CASE("a path of one pose has no velocity, decay shortens it") {
  ppm::Harness still(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 0, sigma_r: 0}");
  still.belief().init(1, ppm::se3_exp(some_twist()), nullptr);
  still.belief().extend(0, {0, 0.0, ppm::se3_exp(some_twist())});
  still.input<ppm::Frame>("frame", frame_at(1, 0.1));
  still.tick();
  CHECK(distance(still.belief().pose[0], ppm::se3_exp(some_twist())) < 1e-15);

  ppm::Harness slowing(ppm::test::builtin(), "motion.constant_velocity",
                       "{sigma_t: 0, sigma_r: 0, velocity_decay: 0.5}");
  begin(slowing.belief(), 1, some_twist());
  slowing.input<ppm::Frame>("frame", frame_at(2, 0.2));
  slowing.tick();
  CHECK(distance(slowing.belief().pose[0], ppm::se3_exp(1.5 * some_twist())) < 1e-12);
}

TEST_CASE("without noise, constant acceleration stays on a path of constant acceleration, over uneven steps too") {
  ppm::Harness h(ppm::test::builtin(), "motion.constant_acceleration", "{sigma_t: 0, sigma_r: 0}");
  // Along one axis, where twists of steps add up: x = t + 2 t^2.
  const auto at = [](double t) {
    Pose pose = Pose::Identity();
    pose.translation().x() = t + 2 * t * t;
    return pose;
  };
  h.belief().init(1, at(0), nullptr);
  for (double t : {0.0, 0.1, 0.3}) h.belief().extend(0, {static_cast<std::int64_t>(10 * t), t, at(t)});
  for (double t : {0.4, 0.6, 0.65, 1.2}) {
    h.input<ppm::Frame>("frame", frame_at(static_cast<std::int64_t>(100 * t), t));
    h.tick();
    CHECK(distance(h.belief().pose[0], at(t)) < 1e-12);
  }
}

TEST_CASE("paths too short for an acceleration have constant velocity, those too short for one stay") {
  for (const std::string module : {"motion.constant_acceleration", "motion.constant_velocity", "motion.random_walk"}) {
    ppm::Harness h(ppm::test::builtin(), module, "{sigma_t: 0, sigma_r: 0}");
    begin(h.belief(), 1, some_twist());
    h.input<ppm::Frame>("frame", frame_at(2, 0.2));
    h.tick();
    CHECK(distance(h.belief().pose[0], ppm::se3_exp((module == "motion.random_walk" ? 1 : 2) * some_twist())) < 1e-12);
    h.belief().init(1, ppm::se3_exp(some_twist()), nullptr);
    h.belief().extend(0, {0, 0.0, ppm::se3_exp(some_twist())});
    h.tick();
    CHECK(distance(h.belief().pose[0], ppm::se3_exp(some_twist())) < 1e-15);
  }
}

TEST_CASE("two poses at one time have no velocity") {
  ppm::Harness h(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 0, sigma_r: 0}");
  h.belief().init(1, Pose::Identity(), nullptr);
  h.belief().extend(0, {0, 0.0, Pose::Identity()});
  h.belief().extend(0, {1, 0.0, ppm::se3_exp(some_twist())});
  h.input<ppm::Frame>("frame", frame_at(2, 0.1));
  h.tick();
  CHECK(distance(h.belief().pose[0], ppm::se3_exp(some_twist())) < 1e-15);
}

TEST_CASE("the noise of constant velocity has the covariance of its parameters, in the camera frame") {
  constexpr std::size_t n = 20'000;
  ppm::Harness h(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 2 cm, sigma_r: 1 deg}");
  begin(h.belief(), n, some_twist());
  h.input<ppm::Frame>("frame", frame_at(2, 0.2));
  h.tick();
  const Pose predicted = ppm::se3_exp(2 * some_twist());
  Twist mean = Twist::Zero();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Twist xi = ppm::se3_log(predicted.inverse() * h.belief().pose[i]);
    mean += xi / n;
    covariance += xi * xi.transpose() / n;
  }
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(0.02), Eigen::Vector3d::Constant(std::numbers::pi / 180);
  // The standard error of a variance from n draws is sqrt(2/n) of it, 1 %: 5 % is beyond 4.9 of them.
  for (int a = 0; a < 6; ++a) {
    CHECK(std::abs(mean[a]) < 4 * sigma[a] / std::sqrt(n));
    CHECK(covariance(a, a) == Approx(sigma[a] * sigma[a]).epsilon(0.05));
    for (int b = 0; b < a; ++b) CHECK(std::abs(covariance(a, b)) < 0.05 * sigma[a] * sigma[b]);
  }
}

TEST_CASE("poses are the same bytes for any number of threads, and differ between seeds and frames") {
  auto run = [](int threads, std::uint64_t seed) {
    ppm::Harness h(ppm::test::builtin(), "motion.constant_velocity", "{}", threads, seed);
    begin(h.belief(), 257, some_twist());
    for (int k = 2; k < 5; ++k) {
      h.input<ppm::Frame>("frame", frame_at(k, 0.1 * k));
      h.tick();
    }
    std::vector<double> all;
    for (const auto& pose : h.belief().pose) all.insert(all.end(), pose.data(), pose.data() + 16);
    return all;
  };
  const auto one = run(1, 7);
  CHECK(run(2, 7) == one);
  CHECK(run(4, 7) == one);
  CHECK(run(1, 8) != one);
}

TEST_CASE("the new frame's motion drops the prediction of the frame before") {
  ppm::Harness h(ppm::test::builtin(), "motion.constant_velocity");
  begin(h.belief(), 1, some_twist());
  h.belief().prediction[0] = std::make_shared<ppm::Prediction>();
  h.input<ppm::Frame>("frame", frame_at(2, 0.2));
  h.tick();
  CHECK(h.belief().prediction[0] == nullptr);
}

TEST_CASE("motion by reference is exact without noise, noisy with it, and needs a reference") {
  const Pose reference = ppm::se3_exp(7 * some_twist());
  ppm::Harness exact(ppm::test::builtin(), "motion.reference_pose");
  begin(exact.belief(), 3, some_twist());
  exact.input<ppm::Frame>("frame", frame_at(12, 1.2, reference));
  exact.tick();
  for (const auto& pose : exact.belief().pose) CHECK(distance(pose, reference) < 1e-15);

  ppm::Harness noisy(ppm::test::builtin(), "motion.reference_pose", "{sigma_t: 1 mm}");
  begin(noisy.belief(), 2, some_twist());
  noisy.input<ppm::Frame>("frame", frame_at(12, 1.2, reference));
  noisy.tick();
  CHECK(distance(noisy.belief().pose[0], reference) > 1e-6);
  CHECK(distance(noisy.belief().pose[0], reference) < 0.01);
  CHECK(distance(noisy.belief().pose[0], noisy.belief().pose[1]) > 1e-6);

  noisy.input<ppm::Frame>("frame", frame_at(13, 1.3));
  CHECK_THROWS_WITH(noisy.tick(),
                    Catch::Matchers::Contains("frame 13") && Catch::Matchers::Contains("no reference pose"));
}

TEST_CASE("motion by reference follows a map that starts elsewhere than at the reference") {
  const Pose first = ppm::se3_exp(5 * some_twist()), second = ppm::se3_exp(7 * some_twist());
  ppm::Harness init(ppm::test::builtin(), "map.ppm_empty", "{particles: 2, start: identity}");
  init.input<ppm::Frame>("frame", frame_at(0, 0.0, first));
  init.tick();
  ppm::Harness motion(ppm::test::builtin(), "motion.reference_pose");
  motion.belief() = std::move(init.belief());
  motion.input<ppm::Frame>("frame", frame_at(1, 0.1, second));
  motion.tick();
  CHECK(distance(motion.belief().pose[1], first.inverse() * second) < 1e-15);

  init.input<ppm::Frame>("frame", frame_at(0, 0.0));  // no reference: its place is not known
  init.tick();
  motion.belief() = std::move(init.belief());
  motion.input<ppm::Frame>("frame", frame_at(14, 0.1, second));
  CHECK_THROWS_WITH(motion.tick(), Catch::Matchers::Contains("frame 14") && Catch::Matchers::Contains("started at"));
}

TEST_CASE("motion parameters are checked") {
  CHECK_THROWS_AS(ppm::Harness(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 2 deg}"), ppm::ConfigError);
  CHECK_THROWS_AS(ppm::Harness(ppm::test::builtin(), "motion.constant_velocity", "{sigma_r: -1}"), ppm::ConfigError);
  CHECK_THROWS_AS(ppm::Harness(ppm::test::builtin(), "motion.constant_velocity", "{velocity_decay: 1.5}"),
                  ppm::ConfigError);
}

TEST_CASE("learnt noise is that of the model's own errors on the path") {
  // A path whose steps differ by 2 cm to and fro: constant velocity misses each by 4 cm.
  ppm::Harness given(ppm::test::builtin(), "motion.constant_velocity", "{sigma_t: 1 cm, sigma_r: 1 deg}");
  ppm::Harness learnt(ppm::test::builtin(), "motion.constant_velocity",
                      "{sigma_t: 1 cm, sigma_r: 1 deg, noise_steps: 6, noise_prior: 1}");
  for (auto* h : {&given, &learnt}) {
    auto& belief = h->belief();
    belief.init(1, Pose::Identity(), nullptr);
    double x = 0;
    for (int k = 0; k < 9; ++k) {
      x += k % 2 ? 0.02 : -0.02;
      belief.extend(0, {k, 0.1 * k, Pose(Eigen::Translation3d(x, 0, 0))});
    }
    h->input<ppm::Frame>("frame", frame_at(9, 0.9));
    h->tick();
  }
  auto variance = [](ppm::Harness& h, int k) {
    return h.belief().column<ppm::MotionPrior>(ppm::kMotionPriorColumn)[0].covariance(k, k);
  };
  CHECK(variance(given, 0) == Approx(1e-4));
  const double errors = 6 * 0.04 * 0.04 / 3;  // along one axis of three
  CHECK(variance(learnt, 0) == Approx((1e-4 + errors) / 7).epsilon(0.01));
  CHECK(variance(learnt, 3) < variance(given, 3));  // it never turned
}

TEST_CASE("noise of a rate grows with the length of the step") {
  auto sigma_of = [](double step_s) {
    ppm::Harness h(ppm::test::builtin(), "motion.random_walk", "{sigma_t: 1 cm, sigma_r: 1 deg, noise_rate: 10 Hz}");
    begin(h.belief(), 1, some_twist());
    h.input<ppm::Frame>("frame", frame_at(2, 0.1 + step_s));
    h.tick();
    return std::sqrt(h.belief().column<ppm::MotionPrior>(ppm::kMotionPriorColumn)[0].covariance(0, 0));
  };
  CHECK(sigma_of(0.1) == Approx(0.01));
  CHECK(sigma_of(0.4) == Approx(0.04));
}
