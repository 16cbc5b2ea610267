#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "framework/core/so3.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/motion_prior.hpp"
#include "tests/support/registry.hpp"

namespace {

using Catch::Matchers::Contains;
using ppm::Matrix6;
using ppm::Pose;

Pose pose(double x, double y, double z, double rx, double ry, double rz) {
  ppm::Twist xi;
  xi << x, y, z, rx, ry, rz;
  return ppm::se3_exp(xi);
}

/// The camera looks forward from a body whose x is forward and z up, from above its centre.
Pose mount() {
  Pose T = Pose::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.translation() << 0.1, 0.05, 0.6;
  return T;
}

struct Run {
  ppm::Harness h;
  int k = 0;
  Pose T_map_camera = pose(1, 2, 3, 0.4, -0.5, 2);

  explicit Run(const std::string& params, bool looks_at_first = true, int threads = 1, std::size_t n = 1)
      : h(ppm::test::builtin(), "motion.odometry", params, threads) {
    h.belief().init(n, T_map_camera, nullptr);
    for (std::size_t i = 0; i < n; ++i) h.belief().extend(i, {0, 0.0, T_map_camera});
    if (looks_at_first) tick(odometry[0]);
    k = 1;
  }
  void tick(std::optional<Pose> T_odom_base) {
    auto frame = std::make_shared<ppm::Frame>();
    frame->index = k++;
    frame->stamp_s = 0.1 * static_cast<double>(frame->index);
    frame->T_base_camera = mount();
    frame->T_odom_base = T_odom_base;
    h.input<ppm::Frame>("frame", std::shared_ptr<const ppm::Frame>(frame));
    h.tick();
  }
  const ppm::MotionPrior& prior() { return h.belief().column<ppm::MotionPrior>(ppm::kMotionPriorColumn)[0]; }

  const std::vector<Pose> odometry{pose(5, 1, 0, 0, 0, 1), pose(5.2, 1.3, 0.01, 0.02, -0.03, 1.4),
                                   pose(5.3, 1.1, 0.02, 0.03, 0.01, 1.1)};
};

double largest(const Eigen::MatrixXd& a) {
  return a.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("without noise the camera moves as its body does, wherever odometry's own frame lies") {
  Run run("{sigma_t: 0, sigma_r: 0, t_per_m: 0, t_per_rad: 0, r_per_m: 0, r_per_rad: 0}");
  Pose expected = run.T_map_camera;
  for (std::size_t k = 1; k < run.odometry.size(); ++k) {
    run.tick(run.odometry[k]);
    expected = expected * mount().inverse() * run.odometry[k - 1].inverse() * run.odometry[k] * mount();
    CHECK(largest(run.prior().T_map_camera.matrix() - expected.matrix()) < 1e-12);
    CHECK(largest(run.h.belief().pose[0].matrix() - expected.matrix()) < 1e-12);
  }
}

TEST_CASE("the noise grows with the step, and is turned to the camera as a twist is") {
  Run run("{sigma_t: 1 mm, sigma_r: 2 mrad, t_per_m: 0.1, t_per_rad: 0.01, r_per_m: 0.02, r_per_rad: 0.03}");
  run.tick(run.odometry[1]);
  const Pose step = run.odometry[0].inverse() * run.odometry[1];
  const double metres = step.translation().norm(), radians = ppm::rotation_angle(step);
  const double t = 0.001 + 0.1 * metres + 0.01 * radians, r = 0.002 + 0.02 * metres + 0.03 * radians;
  const double yaw = std::atan2(step(1, 0), step(0, 0)), pitch = std::asin(-step(2, 0)),
               roll = std::atan2(step(2, 1), step(2, 2));
  // MRPT's deviations are those of x, y, z, yaw, pitch and roll; for small pitch and roll those of a twist.
  REQUIRE(std::abs(pitch) + std::abs(roll) < 0.1);
  REQUIRE(std::abs(yaw) > 0.3);
  ppm::Twist body;
  body << Eigen::Vector3d::Constant(t * t), Eigen::Vector3d::Constant(r * r);
  const Matrix6 turn = ppm::adjoint(mount().inverse());
  const Matrix6 expected = turn * body.asDiagonal() * turn.transpose();
  CHECK(largest(run.prior().covariance - expected) < 0.1 * r * r);
}

TEST_CASE("the noise is that of drawn coordinates") {
  Run run("{sigma_t: 3 mm, sigma_r: 10 mrad, t_per_m: 0, t_per_rad: 0, r_per_m: 0, r_per_rad: 0}");
  run.tick(run.odometry[1]);
  const Pose step = run.odometry[0].inverse() * run.odometry[1];
  const Pose exact = mount().inverse() * step * mount();
  const double yaw = std::atan2(step(1, 0), step(0, 0)), pitch = std::asin(-step(2, 0)),
               roll = std::atan2(step(2, 1), step(2, 2));
  constexpr int runs = 20'000;
  Matrix6 sampled = Matrix6::Zero();
  for (int k = 0; k < runs; ++k) {
    ppm::Rng rng(1, static_cast<std::uint32_t>(k), 0, 0);
    Pose drawn = Pose::Identity();
    for (int a = 0; a < 3; ++a) drawn.translation()[a] = step.translation()[a] + 0.003 * rng.normal();
    drawn.linear() = ppm::so3_exp({0, 0, yaw + 0.01 * rng.normal()}) * ppm::so3_exp({0, pitch + 0.01 * rng.normal(), 0}) *
                     ppm::so3_exp({roll + 0.01 * rng.normal(), 0, 0});
    const ppm::Twist e = ppm::se3_log(exact.inverse() * mount().inverse() * drawn * mount());
    sampled += e * e.transpose() / runs;
  }
  const ppm::Twist sigma = sampled.diagonal().cwiseSqrt();
  CHECK(largest((run.prior().covariance - sampled).cwiseQuotient(sigma * sigma.transpose())) < 0.05);
}

TEST_CASE("odometry that is missing is refused, with the frame") {
  Run run("{}");
  CHECK_THROWS_WITH(run.tick(std::nullopt), Contains("frame 1") && Contains("without odometry"));
  Run late("{}", false);
  CHECK_THROWS_WITH(late.tick(run.odometry[1]), Contains("frame 1") && Contains("from the first frame on"));
  Pose broken = run.odometry[1];
  broken.translation().x() = NAN;
  Run other("{}");
  CHECK_THROWS_WITH(other.tick(broken), Contains("frame 1") && Contains("not finite"));
}

TEST_CASE("odometry gives the same bytes for any number of threads, and after a checkpoint") {
  const auto run_of = [](int threads, bool stop) {
    Run run("{}", true, threads, 30);
    run.tick(run.odometry[1]);
    if (!stop) {
      run.tick(run.odometry[2]);
      return run.h.belief().pose;
    }
    Run next("{}", false, threads, 30);
    next.h.load(run.h.save(), 2);
    next.h.belief() = std::move(run.h.belief());
    next.k = 2;
    next.tick(run.odometry[2]);
    return next.h.belief().pose;
  };
  const auto one = run_of(1, false);
  const auto same = [&](const std::vector<Pose>& other) {
    for (std::size_t i = 0; i < one.size(); ++i)
      if (one[i].matrix() != other[i].matrix()) return false;
    return true;
  };
  CHECK(same(run_of(3, false)));
  CHECK(same(run_of(1, true)));
  CHECK(same(run_of(2, true)));
}
