#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "framework/core/error.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/motion_prior.hpp"
#include "tests/support/imu_world.hpp"
#include "tests/support/registry.hpp"

namespace {

using Catch::Matchers::Contains;
using ppm::ImuFilter;
using ppm::Pose;
using ppm::test::SwingingBody;

constexpr double kFrame_s = 0.1;

Pose camera_on_body() {
  ppm::Twist xi;
  xi << 0.1, -0.05, 0.2, 0.3, -1.2, 0.4;
  return ppm::se3_exp(xi);
}

double at_s(int k) {
  return 1 + kFrame_s * k;
}

ppm::Frame frame_of(const SwingingBody& body, int k, double imu_step_s = 0.005) {
  ppm::Frame frame;
  frame.index = k;
  frame.stamp_s = at_s(k);
  frame.T_base_camera = camera_on_body();
  frame.imu = body.samples(at_s(k - 1), at_s(k), imu_step_s);
  return frame;
}

Pose camera_pose(const SwingingBody& body, int k) {
  return body.pose(at_s(k)) * camera_on_body();
}

/// motion.imu with n particles whose path is corrected to the exact one after each frame, or left as drawn.
struct Run {
  SwingingBody body;
  ppm::Harness h;

  explicit Run(const std::string& params, std::size_t n = 1, int threads = 1)
      : h(ppm::test::builtin(), "motion.imu", params, threads, 7) {
    h.belief().init(n, camera_pose(body, 0), nullptr);
    for (std::size_t i = 0; i < n; ++i) h.belief().extend(i, {0, at_s(0), camera_pose(body, 0)});
  }
  void tick(const ppm::Frame& frame) {
    h.input<ppm::Frame>("frame", std::make_shared<const ppm::Frame>(frame));
    h.tick();
  }
  const ppm::MotionPrior& prior(std::size_t i = 0) {
    return h.belief().column<ppm::MotionPrior>(ppm::kMotionPriorColumn)[i];
  }
  const ImuFilter& filter(std::size_t i = 0) { return h.belief().column<ImuFilter>("motion.imu")[i]; }
  void settle(int k) {
    for (std::size_t i = 0; i < h.belief().size(); ++i) h.belief().correct(i, camera_pose(body, k));
  }
  double metric(const std::string& name) {
    return h.context().metrics().columns().at("motion.imu." + name).back().value;
  }
  double error(int k) { return prior().offset(camera_pose(body, k)).norm(); }
};

std::vector<double> numbers(ppm::ParticleSet& belief) {
  std::vector<double> all;
  for (std::size_t i = 0; i < belief.size(); ++i) {
    const auto& T = belief.pose[i].matrix();
    all.insert(all.end(), T.data(), T.data() + 16);
    const auto& c = belief.column<ImuFilter>("motion.imu")[i].covariance;
    all.insert(all.end(), c.data(), c.data() + c.size());
  }
  return all;
}

}  // namespace

TEST_CASE("an inertial unit foretells the next pose, the better the longer its path is known") {
  Run run("{sigma_t: 0.1 mm, sigma_r: 0.1 mrad, gyro_noise: 1e-4, accel_noise: 1e-3}");
  run.tick(frame_of(run.body, 0));  // only looked at: the map begins with it
  CHECK(run.h.belief().trajectory[0].length() == 1);
  double early = 0, late = 0;
  for (int k = 1; k <= 60; ++k) {
    run.tick(frame_of(run.body, k));
    if (k == 1) early = run.error(k);
    if (k > 50) late = std::max(late, run.error(k));
    // What was foretold is as good as it says.
    CHECK(run.prior().offset(camera_pose(run.body, k)).norm() < 6 * std::sqrt(run.prior().covariance.trace()));
    run.settle(k);
  }
  CHECK(early > 0.02);  // the body moves already, which is not known
  CHECK(late < 3e-4);
  CHECK(run.filter().velocity.isApprox(run.body.velocity(at_s(60)), 0.01));
  CHECK(run.metric("speed") == Approx(run.body.velocity(at_s(59)).norm()).epsilon(0.01));
}

TEST_CASE("the spread of what is foretold is that of velocity and biases, at the camera") {
  Run run("{sigma_t: 0, sigma_r: 0, start_speed: 0.5 m/s, gyro_noise: 1e-6, accel_noise: 1e-6, start_accel: 0, "
          "start_accel_bias: 0, start_gyro_bias: 0.1 rad/s}");
  run.tick(frame_of(run.body, 1));
  // In 0.1 s: 5 cm by the velocity, 10 mrad by the bias about each axis, and what those swing the camera by.
  const ppm::Matrix6 c = run.prior().covariance;
  const Eigen::Vector3d arm = camera_on_body().translation();
  CHECK(std::sqrt(c.bottomRightCorner<3, 3>().trace() / 3) == Approx(0.01).epsilon(0.01));
  const double by_arm = 1e-4 * 2 * arm.squaredNorm();
  CHECK(c.topLeftCorner<3, 3>().trace() == Approx(3 * 0.0025 + by_arm).epsilon(0.02));
}

TEST_CASE("poses and filters are the same bytes for any number of threads, and after a checkpoint") {
  const auto run_of = [](int threads, int checkpoint) {
    auto run = std::make_unique<Run>("{}", 40, threads);
    for (int k = 0; k < 6; ++k) {
      if (k == checkpoint) {
        auto next = std::make_unique<Run>("{}", 40, threads);
        next->h.load(run->h.save(), k);
        next->h.belief() = std::move(run->h.belief());
        run = std::move(next);
      }
      run->tick(frame_of(run->body, k));
    }
    return numbers(run->h.belief());
  };
  const auto one = run_of(1, -1);
  CHECK(run_of(3, -1) == one);
  CHECK(run_of(1, 1) == one);
  CHECK(run_of(2, 4) == one);
}

TEST_CASE("a filter's bytes come back from a checkpoint") {
  Run run("{}");
  run.tick(frame_of(run.body, 1));
  ppm::RecordWriter out;
  out.add(run.filter());
  ppm::RecordReader in(out.bytes(), "file", "filter");
  const auto back = in.take<ImuFilter>();
  in.finish();
  CHECK(back.covariance == run.filter().covariance);
  CHECK(back.gravity == run.filter().gravity);
  CHECK(back.stamp_s == run.filter().stamp_s);
  CHECK(back.T_map_base.matrix() == run.filter().T_map_base.matrix());
}

TEST_CASE("resampling moves what a particle knows with it") {
  Run run("{}", 3);
  run.tick(frame_of(run.body, 1));
  run.tick(frame_of(run.body, 2));
  const auto third = run.filter(2).velocity;
  CHECK(third != run.filter(0).velocity);
  run.h.belief().gather({2, 2, 1});
  CHECK(run.filter(0).velocity == third);
}

TEST_CASE("a particle that was found elsewhere begins anew with its velocity") {
  Run run("{}");
  for (int k = 1; k < 10; ++k) {
    run.tick(frame_of(run.body, k));
    run.settle(k);
  }
  const auto away = [&](int k) {
    Pose T = camera_pose(run.body, k);
    T.translation().x() += 3;
    return T;
  };
  const auto follows = [&](int k) { return (run.prior().T_map_camera.translation() - away(k).translation()).norm() < 0.2; };
  SECTION("at once where the belief was lost") {
    run.h.belief().lost = true;
    run.h.belief().correct(0, away(9));
    run.tick(frame_of(run.body, 10));
    CHECK(run.metric("restarts") == 1);
    CHECK(follows(10));
    CHECK(run.prior().covariance.topLeftCorner<3, 3>().trace() > 3 * 0.0003);
    run.h.belief().lost = false;  // found elsewhere in this frame
    run.h.belief().correct(0, camera_pose(run.body, 10));
    run.tick(frame_of(run.body, 11));
    CHECK(run.metric("restarts") == 1);
    run.tick(frame_of(run.body, 12));
    CHECK(run.metric("restarts") == 0);
  }
  SECTION("else after some frames in a row, until which its own motion is believed") {
    for (int k = 9; k < 15; ++k) {
      run.h.belief().correct(0, away(k));
      run.tick(frame_of(run.body, k + 1));
      CHECK(run.metric("restarts") == (k == 14 ? 1 : 0));
      CHECK(follows(k + 1) == (k == 14));
    }
  }
}

TEST_CASE("what the image did not say of a pose teaches no velocity") {
  const auto velocity = [](double slide_m, double information_along_x) {
    Run run("{}");
    run.tick(frame_of(run.body, 0));
    for (int k = 1; k < 20; ++k) {
      run.tick(frame_of(run.body, k));
      run.settle(k);
    }
    ppm::Matrix6 seen = 1e6 * ppm::Matrix6::Identity();
    seen(0, 0) = information_along_x;
    run.h.belief().column<ppm::Matrix6>(ppm::kMotionSeenColumn)[0] = seen;
    ppm::Twist slide = ppm::Twist::Zero();
    slide[0] = slide_m;  // of the camera, along a bare wall
    run.h.belief().correct(0, run.prior().T_map_camera * ppm::se3_exp(slide));
    run.tick(frame_of(run.body, 20));
    return run.filter().velocity;
  };
  CHECK((velocity(0.005, 0) - velocity(0, 0)).norm() < 1e-5);
  CHECK((velocity(0.005, 1e6) - velocity(0, 1e6)).norm() > 1e-3);
}

TEST_CASE("inertial samples that are missing, out of order or broken are refused, with the frame") {
  SwingingBody body;
  const auto tick = [&](const std::function<void(ppm::Frame&)>& spoil) {
    Run run("{}");
    auto frame = frame_of(body, 1);
    spoil(frame);
    run.tick(frame);
  };
  CHECK_THROWS_WITH(tick([](auto& f) { f.imu.clear(); }),
                    Contains("frame 1") && Contains("without inertial samples"));
  CHECK_THROWS_WITH(tick([](auto& f) { std::swap(f.imu[3], f.imu[4]); }), Contains("frame 1") && Contains("is not between"));
  CHECK_THROWS_WITH(tick([](auto& f) { f.imu.front().stamp_s = 0.5; }), Contains("is not between"));
  CHECK_THROWS_WITH(tick([](auto& f) { f.imu.back().stamp_s = 9; }), Contains("is not between"));
  CHECK_THROWS_WITH(tick([](auto& f) { f.imu[2].gyro.x() = NAN; }), Contains("not finite"));
  const std::string gap = "{max_gap: 20 ms}";
  Run run(gap);
  auto frame = frame_of(body, 1);
  frame.imu.erase(frame.imu.begin() + 5, frame.imu.begin() + 12);
  CHECK_THROWS_WITH(run.tick(frame), Contains("frame 1") && Contains("max_gap"));
  frame = frame_of(body, 1);
  frame.imu.resize(10);
  CHECK_THROWS_WITH(run.tick(frame), Contains("to the image's") && Contains("max_gap"));
}
