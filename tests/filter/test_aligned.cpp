#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/graph/graph.hpp"
#include "framework/slam/motion_prior.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "tests/support/mapped_view.hpp"
#include "tests/support/mesh_map.hpp"

namespace {

using namespace ppm;

constexpr double kDegree = std::numbers::pi / 180;

test::MappedView& room() {
  static test::MappedView view(test::make_map(meshed_room(4000)));
  return view;
}

Twist offset(double t, double r) {
  Twist xi;
  xi << 0.8 * t, -0.3 * t, 0.5 * t, 0.5 * r, -0.8 * r, 0.3 * r;
  return xi;
}

Matrix6 covariance(double sigma_t, double sigma_r) {
  Twist s;
  s << Eigen::Vector3d::Constant(sigma_t), Eigen::Vector3d::Constant(sigma_r);
  return s.array().square().matrix().asDiagonal();
}

double apart_m(const Pose& a, const Pose& b) {
  return (a.inverse() * b).translation().norm();
}

/// n particles of a map that the motion model expects at `mean`, and has drawn there.
struct Aligned {
  Harness h;
  Aligned(test::MappedView& world, std::size_t n, const Pose& mean, const Matrix6& cov, const std::string& params = "{}",
          int threads = 1)
      : h(test::builtin(), "motion.aligned", params, threads) {
    h.use("view", world.predictor());
    auto& belief = h.belief();
    belief.init(n, mean, world.map());
    for (std::size_t i = 0; i < n; ++i) {
      belief.extend(i, {0, 0.0, mean});
      belief.extend(i, {1, 1.0, mean});
      belief.column<MotionPrior>(kMotionPriorColumn)[i] = {mean, cov};
    }
  }
  void see(const Frame& frame) {
    h.input<Frame>("frame", std::make_shared<const Frame>(frame));
    h.tick();
  }
  double metric(const std::string& name) {
    return h.context().metrics().columns().at("motion.aligned." + name).back().value;
  }
};

}  // namespace

TEST_CASE("a particle near its place is laid onto it") {
  const Pose truth = room_view(0.7);
  Aligned one(room(), 1, truth * se3_exp(offset(0.03, 2 * kDegree)), covariance(0.02, 2 * kDegree), "{draw: optimum}");
  one.see(room().frame(truth));
  CHECK(apart_m(one.h.belief().pose[0], truth) < 0.002);
  CHECK(rotation_angle(one.h.belief().pose[0].inverse() * truth) < 0.1 * kDegree);
  CHECK(one.h.belief().trajectory[0].last().T_map_camera.isApprox(one.h.belief().pose[0]));
  CHECK(one.h.belief().trajectory[0].length() == 2);
  CHECK(one.metric("failed") == 0);
  CHECK(one.metric("starts") == 0);
  CHECK(one.metric("outliers") < 0.02);
}

TEST_CASE("one far from its place is found by many starts, with the same bytes for any number of threads") {
  const Pose truth = room_view(0.7);
  const Frame frame = room().frame(truth);
  const Pose expected = truth * se3_exp(offset(0.6, 45 * kDegree));
  std::vector<Pose> found;
  for (int threads : {1, 3}) {
    Aligned one(room(), 2, expected, covariance(0.03, 3 * kDegree), "{}", threads);
    one.see(frame);
    CHECK(one.metric("starts") > 0);
    CHECK(one.metric("places") >= 1);
    const auto best = one.h.belief().best();
    CHECK(apart_m(one.h.belief().pose[best], truth) < 0.01);
    found.push_back(one.h.belief().pose[best]);
  }
  CHECK((found[0].matrix().array() == found[1].matrix().array()).all());
}

TEST_CASE("without a search it keeps what the motion model drew, and says so") {
  const Pose truth = room_view(0.7);
  const Pose expected = truth * se3_exp(offset(0.8, 60 * kDegree));
  Aligned one(room(), 3, expected, covariance(0.01, 1 * kDegree), "{stages: 0}");
  one.see(room().frame(truth));
  CHECK(one.metric("failed") == 1);
  for (const auto& pose : one.h.belief().pose) CHECK(pose.isApprox(expected));
  for (double w : one.h.belief().log_weight) CHECK(w == Approx(-std::log(3.0)));
}

TEST_CASE("along a bare wall particles keep the spread of the prior") {
  // A wall that fills the view, 1.5 m away.
  test::MappedView wall(test::make_map(test::height_field(40, 6.f, [](float, float) { return 1.5f; })));
  const Pose truth = Pose::Identity();
  constexpr std::size_t kParticles = 400;
  Aligned many(wall, kParticles, truth * Pose(Eigen::Translation3d(0, 0, 0.03)), covariance(0.04, 1 * kDegree));
  many.see(wall.frame(truth));
  REQUIRE(many.metric("failed") == 0);
  Twist square = Twist::Zero();
  for (const auto& pose : many.h.belief().pose) square += se3_log(pose).cwiseAbs2();
  const Twist spread = (square / static_cast<double>(kParticles)).cwiseSqrt();
  CHECK(spread[0] == Approx(0.04).epsilon(0.15));
  CHECK(spread[1] == Approx(0.04).epsilon(0.15));
  CHECK(spread[2] < 0.005);
  CHECK(spread[5] == Approx(1 * kDegree).epsilon(0.15));
  CHECK(spread[3] < 0.3 * kDegree);
}

TEST_CASE("weights take the prior's density over that of the draw") {
  // Where the view says nothing that the prior does not know better, the draw is the prior's and weights stay even; where the
  // view is sharp, a draw farther from what motion expects is the less likely one.
  const Pose truth = room_view(0.7);
  Aligned far(room(), 1, truth * se3_exp(offset(0.05, 0)), covariance(0.01, 1 * kDegree), "{draw: optimum, tail_share: 0}");
  auto& belief = far.h.belief();
  belief.init(2, truth, room().map());
  for (std::size_t i = 0; i < 2; ++i) {
    belief.extend(i, {0, 0.0, truth});
    belief.extend(i, {1, 1.0, truth});
    belief.column<MotionPrior>(kMotionPriorColumn)[i] = {truth * se3_exp(offset(i == 0 ? 0.0 : 0.05, 0)),
                                                         covariance(0.01, 1 * kDegree)};
  }
  far.see(room().frame(truth));
  const Twist missed = offset(0.05, 0);
  const double expected = -0.5 * missed.head<3>().squaredNorm() / (0.01 * 0.01);
  CHECK(belief.log_weight[1] - belief.log_weight[0] == Approx(expected).epsilon(0.2));
}

TEST_CASE("a frame without returns moves nothing") {
  const Pose at = room_view(0.7);
  Frame frame = room().frame(at);
  std::fill(frame.depth.begin(), frame.depth.end(), std::numeric_limits<float>::quiet_NaN());
  Aligned one(room(), 2, at, covariance(0.01, 1 * kDegree), "{stages: 1}");
  one.see(frame);
  CHECK(one.metric("failed") == 1);
  for (const auto& pose : one.h.belief().pose) CHECK(pose.isApprox(at));
}

TEST_CASE("the node that a node calls is named, and must be of its kind") {
  auto mistakes = [](const std::string& in) -> std::string {
    const std::string yaml =
        "name: g\nnodes:\n"
        "  - {name: camera, module: source.synthetic_room}\n"
        "  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}}\n"
        "  - {name: prior, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1}}\n"
        "  - {name: motion, module: motion.aligned, in: {frame: camera.frame" + in + "}, when: {from_frame: 1}}\n"
        "  - {name: look, module: prediction.raster, in: {frame: camera.frame}}\n";
    try {
      Graph::build(parse_yaml(yaml, "g.yaml"), test::builtin());
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  CHECK(mistakes(", view: look") == "");
  CHECK(mistakes("") ==
        "g.yaml:6:28: input 'view' of module 'motion.aligned' is not wired; did you mean in: {view: look}?");
  CHECK(mistakes(", view: lok") == "g.yaml:6:76: no node 'lok'; did you mean 'look'?");
  CHECK(mistakes(", view: motion") == "g.yaml:6:76: node 'motion' cannot use itself");
  CHECK(mistakes(", view: camera") ==
        "g.yaml:6:76: input 'view' takes a node that is a 'prediction.*', but 'camera' is 'source.synthetic_room'");
  CHECK(mistakes(", view: camera.frame") ==
        "g.yaml:6:76: input 'view' names a node that is called, such as 'look', without an output");
}
