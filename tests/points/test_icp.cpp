// Nearest neighbours against brute force, and registration to a room of points.
#include <catch2/catch.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "framework/slam/motion_prior.hpp"
#include "modules/maps/points/point_index.hpp"
#include "tests/map_update/box_world.hpp"
#include "tests/points/points.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSigma = 0.003;

BoxWorld world_of_boxes() {
  BoxWorld world;
  world.boxes.push_back({Eigen::Vector3d(-0.9, 0.2, 1.4), Eigen::Vector3d(-0.3, 1.2, 2.0)});
  world.boxes.push_back({Eigen::Vector3d(0.4, -0.3, 1.7), Eigen::Vector3d(0.9, 0.1, 2.4)});
  return world;
}

/// A map of the world as a few frames from about `pose` make it.
std::shared_ptr<const PointMap> mapped(const BoxWorld& world, const Camera& camera, const Pose& pose) {
  Harness update(builtin(), "map_update.points");
  PointView view;
  update.belief().init(1, pose, std::make_shared<PointMap>(0.03));
  for (std::uint32_t k = 0; k < 6; ++k) {
    const Pose at = pose * se3_exp((Twist() << 0.02 * (k % 3), 0.02 * (k % 2), 0, 0.01 * (k % 2), 0.02 * (k % 3), 0).finished());
    update.belief().pose[0] = at;
    update.belief().prediction[0] = std::make_shared<const Prediction>(view.of(*update.belief().map[0], camera, at));
    update.input<Frame>("frame", std::make_shared<const Frame>(world.frame(camera, at, kSigma, k, true)));
    update.tick();
  }
  return std::static_pointer_cast<const PointMap>(update.belief().map[0]);
}

struct Scene {
  BoxWorld world = world_of_boxes();
  Camera camera{160, 120, 140, 140, 79.5, 59.5};
  Pose pose = look({0.1, -0.1, 0}, 0.1, 0.05);
  std::shared_ptr<const PointMap> map = mapped(world, camera, pose);
};
const Scene& scene() {
  static const Scene scene;
  return scene;
}

Twist offset(double t, double r) {
  Twist xi;
  xi << 0.7 * t, -0.4 * t, 0.6 * t, 0.6 * r, -0.7 * r, 0.4 * r;
  return xi;
}

Matrix6 covariance(double sigma_t, double sigma_r) {
  Twist s;
  s << Eigen::Vector3d::Constant(sigma_t), Eigen::Vector3d::Constant(sigma_r);
  return s.array().square().matrix().asDiagonal();
}

/// n particles that the motion model expects at `mean`.
struct Registered {
  Harness h;
  Registered(std::size_t n, const Pose& mean, const std::string& params = "{}", int threads = 1, const Scene& at = scene())
      : h(builtin(), "motion.icp", params, threads) {
    auto& belief = h.belief();
    belief.init(n, mean, at.map);
    for (std::size_t i = 0; i < n; ++i) {
      belief.extend(i, {0, 0.0, mean});
      belief.extend(i, {1, 1.0, mean});
      belief.column<MotionPrior>(kMotionPriorColumn)[i] = {mean, covariance(0.05, 4 * kDegree)};
    }
  }
  void see(Frame frame) {
    h.input<Frame>("frame", std::make_shared<const Frame>(std::move(frame)));
    h.tick();
  }
  void see() { see(scene().world.frame(scene().camera, scene().pose, kSigma, 77, true)); }
  double metric(const std::string& name) { return h.context().metrics().columns().at("motion.icp." + name).back().value; }
  double error_m(std::size_t i = 0) { return (scene().pose.inverse() * h.belief().pose[i]).translation().norm(); }
  double error_deg(std::size_t i = 0) { return rotation_angle(scene().pose.inverse() * h.belief().pose[i]) / kDegree; }
};

}  // namespace

TEST_CASE("the nearest point of a map, across its tiles, is that of brute force") {
  Rng rng(8, 0, 0, purpose_key("index"));
  auto direction = [&] { return Eigen::Vector3f(Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).cast<float>()).normalized(); };
  auto place = [&](float extent) {
    return Eigen::Vector3f(Eigen::Vector3d(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5).cast<float>() * extent);
  };
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 5000; ++i) points.push_back(surface_point(place(2), direction(), 0.02f));
  const auto map = with(std::make_shared<PointMap>(0.02), points);
  REQUIRE(map->table().size() > 20);
  PointIndexes indexes;
  indexes.update({map.get()}, one_worker());
  const PointFinder finder = indexes.of(*map);
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f p = place(2.4f), n = i % 2 ? direction() : Eigen::Vector3f::Zero();
    const float distance = 0.02f + 0.2f * static_cast<float>(rng.uniform()), cosine = 0.3f;
    float least = distance * distance;
    bool any = false;
    for (const auto& q : points) {
      const float square = (q.position - p).squaredNorm();
      if (square < least && (n.isZero() || q.normal.vector().dot(n) >= cosine)) least = square, any = true;
    }
    const NearestPoint found = finder.nearest(p, n, distance, cosine);
    REQUIRE((found.point != nullptr) == any);
    if (any) CHECK(found.square == Approx(least).epsilon(1e-5));
    missed += !any;
  }
  CHECK(missed > 50);
  CHECK(missed < 1500);
}

TEST_CASE("trees are built for tiles that changed, and shared where maps share tiles") {
  const auto parent = scene().map;
  PointEdit edit(parent);
  edit.points(0).front().hits = 3;
  const auto child = edit.commit();
  std::size_t tiles = 0;
  for (const auto& chunk : parent->table().chunks()) tiles += !chunk.tile->points.empty();
  PointIndexes indexes;
  indexes.update({parent.get()}, one_worker());
  CHECK(indexes.built() == tiles);
  indexes.update({parent.get(), child.get()}, one_worker());
  CHECK(indexes.built() == 1);
  CHECK(indexes.size() == tiles + 1);
  indexes.update({child.get()}, one_worker());
  CHECK(indexes.built() == 0);
  CHECK(indexes.size() == tiles);
  CHECK_THROWS_AS(indexes.of(*parent), InternalError);
}

TEST_CASE("registration recovers known offsets, by planes to millimetres") {
  for (const auto& [t, r] : {std::pair{0.0, 0.0}, {0.02, 1.0}, {0.05, 3.0}}) {
    Registered one(1, scene().pose * se3_exp(offset(t, r * kDegree)));
    one.see();
    INFO(t << " m, " << r << " deg");
    CHECK(one.metric("failed") == 0);
    CHECK(one.metric("outliers") < 0.05);
    CHECK(one.metric("inliers") > 0.7);
    CHECK(one.error_m() < 0.003);
    CHECK(one.error_deg() < 0.15);
    CHECK(one.h.belief().trajectory[0].last().T_map_camera.isApprox(one.h.belief().pose[0]));
  }
}

TEST_CASE("by points it comes near, but slides less well than by planes") {
  Registered points(1, scene().pose * se3_exp(offset(0.02, 1 * kDegree)), "{error: point, iterations: 40}");
  points.see();
  CHECK(points.metric("failed") == 0);
  CHECK(points.error_m() < 0.012);
  CHECK(points.error_deg() < 0.6);
}

TEST_CASE("trimming takes out what moved") {
  Scene changed = scene();
  changed.world.boxes.push_back({Eigen::Vector3d(-0.3, -0.5, 2.92), Eigen::Vector3d(0.4, 0.3, 3.1)});  // 8 cm before the wall
  const Frame frame = changed.world.frame(changed.camera, changed.pose, kSigma, 78, true);
  auto error = [&](const std::string& params) {
    Registered one(1, scene().pose * se3_exp(offset(0.02, 1 * kDegree)), params);
    one.see(frame);
    return one.error_m();
  };
  const double trimmed = error("{trim: 0.3, distance: 10 cm}"), whole = error("{trim: 0, distance: 10 cm}");
  CHECK(trimmed < 0.004);
  CHECK(trimmed < 0.5 * whole);
}

TEST_CASE("along a bare wall the prior's mean stays") {
  Scene wall;
  wall.world.room = {Eigen::Vector3d(-20, -20, -1), Eigen::Vector3d(20, 20, 1.5)};
  wall.world.boxes.clear();
  wall.pose = look({0, 0, 0});
  wall.map = mapped(wall.world, wall.camera, wall.pose);
  const Pose mean = wall.pose * Pose(Eigen::Translation3d(0.03, -0.02, 0.03));
  Registered one(1, mean, "{}", 1, wall);
  one.see(wall.world.frame(wall.camera, wall.pose, kSigma, 77, true));
  REQUIRE(one.metric("failed") == 0);
  const Eigen::Vector3d at = one.h.belief().pose[0].translation();
  CHECK(at.x() == Approx(0.03).margin(0.003));
  CHECK(at.y() == Approx(-0.02).margin(0.003));
  CHECK(std::abs(at.z()) < 0.003);
}

TEST_CASE("draws spread around the optimum, with the same bytes for any number of threads") {
  std::vector<std::vector<Pose>> drawn;
  for (int threads : {1, 3}) {
    Registered many(6, scene().pose * se3_exp(offset(0.02, 1 * kDegree)), "{draw: sample, alpha: 0.01}", threads);
    many.see();
    drawn.push_back(many.h.belief().pose);
    for (std::size_t i = 1; i < 6; ++i) CHECK((drawn.back()[i].matrix() - drawn.back()[0].matrix()).norm() > 1e-6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(many.error_m(i) < 0.01);
    CHECK(std::accumulate(many.h.belief().log_weight.begin(), many.h.belief().log_weight.end(), 0.0,
                          [](double sum, double w) { return sum + std::exp(w); }) == Approx(1));
  }
  for (std::size_t i = 0; i < 6; ++i) CHECK((drawn[0][i].matrix().array() == drawn[1][i].matrix().array()).all());
}

TEST_CASE("where registration fails the motion model's draw stays, and it says so") {
  const Pose far = scene().pose * se3_exp(offset(1.5, 100 * kDegree));
  Registered lost(2, far);
  lost.see();
  CHECK(lost.metric("failed") == 1);
  for (const auto& pose : lost.h.belief().pose) CHECK(pose.isApprox(far));
  for (double w : lost.h.belief().log_weight) CHECK(w == Approx(-std::log(2.0)));

  Registered blind(1, scene().pose);
  Frame frame = scene().world.frame(scene().camera, scene().pose, kSigma, 77, true);
  std::ranges::fill(frame.depth, std::numeric_limits<float>::quiet_NaN());
  blind.see(frame);
  CHECK(blind.metric("failed") == 1);
  CHECK(blind.h.belief().pose[0].isApprox(scene().pose));
}
