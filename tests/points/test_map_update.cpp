// map_update.points, frame by frame in worlds of boxes.
#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "tests/map_update/box_world.hpp"
#include "tests/points/points.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSigma = 0.004;

/// Particles that map a world of boxes.
class Run {
 public:
  BoxWorld world;

  explicit Run(const std::string& params = "{}", int threads = 1, std::size_t particles = 1, double spacing = 0.03)
      : harness_(builtin(), "map_update.points", params, threads) {
    harness_.belief().init(particles, look({0, 0, 0}), std::make_shared<PointMap>(spacing));
  }
  void step(const Pose& pose, int stride = 1, bool noisy = true) {
    auto& belief = harness_.belief();
    harness_.input<Frame>("frame", std::make_shared<const Frame>(world.frame(small_camera(), pose, kSigma, frames_++, noisy)));
    for (std::size_t k = 0; k < belief.size(); ++k) {
      belief.pose[k] = pose * Eigen::Translation3d(0.001 * static_cast<double>(k), 0, 0);
      belief.prediction[k] = std::make_shared<const Prediction>(view_.of(*belief.map[k], small_camera(), belief.pose[k], stride));
    }
    harness_.tick();
  }
  const PointMap& map(std::size_t k = 0) { return static_cast<const PointMap&>(*harness_.belief().map[k]); }
  /// Median error of the range of what is hit, m; and the share that is.
  std::pair<double, double> error(const Pose& pose) {
    const Prediction seen = view_.of(map(), small_camera(), pose);
    std::vector<double> errors;
    for (std::size_t p = 0; p < seen.range.size(); ++p)
      if (seen.hit(p)) errors.push_back(std::abs(seen.range[p] - world.distance(pose.translation(), seen.direction(p))));
    const double share = static_cast<double>(errors.size()) / static_cast<double>(seen.range.size());
    if (errors.empty()) return {0, 0};
    std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
    return {errors[errors.size() / 2], share};
  }
  Harness& harness() { return harness_; }

 private:
  Harness harness_;
  PointView view_;
  std::uint32_t frames_ = 0;
};

std::size_t inside(const PointMap& map, const Eigen::AlignedBox3d& box) {
  std::size_t count = 0;
  for (const auto& p : all_points(map)) count += box.contains(p.position.cast<double>());
  return count;
}

}  // namespace

TEST_CASE("frame by frame the points come nearer to the surface than one frame's noise") {
  Run run;
  const Pose pose = look({0.1, 0, 0}, 0.1);
  run.step(pose);
  const auto first = run.error(pose);
  for (int k = 0; k < 15; ++k) run.step(look({0.1 - 0.01 * k, 0.004 * k, 0}, 0.1));
  const auto last = run.error(pose);
  CHECK(first.second > 0.8);  // the image's rim has no normals, and steep walls come later
  CHECK(last.second > first.second);
  CHECK(last.first < 0.5 * first.first);
  CHECK(last.first < 0.0015);
}

TEST_CASE("points of one surface are the spacing apart, and two frames of it make few more than one") {
  Run run;
  run.step(look({0, 0, 0}));
  const auto one = run.map().stats().vertices;
  for (int k = 0; k < 10; ++k) run.step(look({0, 0, 0}));
  CHECK(run.map().stats().vertices < one * 5 / 4);
  const auto points = all_points(run.map());
  std::size_t crowded = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      crowded += (points[i].position - points[j].position).norm() < 0.8f * 0.03f &&
                 points[i].normal.vector().dot(points[j].normal.vector()) > 0.9f;
  CHECK(crowded < points.size() / 50);
}

TEST_CASE("the variance that a point learns is that of the poses' error") {
  Run good, bad;
  for (int k = 0; k < 40; ++k) {
    good.step(look({0, 0, 0}));
    // The frame is of another place than it says: 1 cm along the view, to and fro.
    bad.world.room = {Eigen::Vector3d(-2, -1.2, -1), Eigen::Vector3d(2, 1.2, 3 + (k % 2 ? 0.01 : -0.01))};
    bad.step(look({0, 0, 0}));
  }
  auto median_sigma = [](const PointMap& map) {
    std::vector<float> sigma;
    for (const auto& p : all_points(map))
      if (p.position.z() > 2.9f && p.hits > 30) sigma.push_back(std::sqrt(p.variance()));
    REQUIRE(sigma.size() > 100);
    std::ranges::nth_element(sigma, sigma.begin() + static_cast<std::ptrdiff_t>(sigma.size() / 2));
    return sigma[sigma.size() / 2];
  };
  CHECK(median_sigma(good.map()) < 0.006f);
  CHECK(median_sigma(bad.map()) == Approx(0.0105f).margin(0.003));
}

TEST_CASE("what has moved away is seen through and goes, what stands stays") {
  Run run;
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.3, -0.3, 1.2), Eigen::Vector3d(0.3, 0.3, 1.6));
  run.world.boxes.push_back(box);
  for (int k = 0; k < 5; ++k) run.step(look({0, 0, 0}));
  const Eigen::AlignedBox3d around(box.min() - Eigen::Vector3d::Constant(0.03), box.max() + Eigen::Vector3d::Constant(0.03));
  CHECK(inside(run.map(), around) > 100);
  run.world.boxes.clear();
  const auto elsewhere = run.map().stats().vertices - static_cast<std::int64_t>(inside(run.map(), around));
  for (int k = 0; k < 12; ++k) run.step(look({0, 0, 0}));
  CHECK(inside(run.map(), around) < 10);
  CHECK(run.map().stats().vertices >= elsewhere);
  CHECK(run.error(look({0, 0, 0})).second > 0.9);
}

TEST_CASE("a coarser view updates on its own grid") {
  Run run("{}", 1, 1, 0.05);
  run.step(look({0, 0, 0}), 2);
  run.step(look({0, 0, 0}), 2);
  CHECK(run.error(look({0, 0, 0})).second > 0.6);
  CHECK(run.error(look({0, 0, 0})).first < 0.01);
}

TEST_CASE("point maps are the same bytes for any number of threads") {
  std::vector<std::string> digests;
  for (int threads : {1, 3}) {
    Run run("{}", threads, 5);
    for (int k = 0; k < 4; ++k) run.step(look({0.02 * k, 0, 0}, 0.05 * k));
    Digest digest;
    for (std::size_t p = 0; p < 5; ++p) run.map(p).digest(digest);
    digests.push_back(digest.hex());
  }
  CHECK(digests[0] == digests[1]);
}

TEST_CASE("without a prediction the update says so") {
  Run run;
  run.harness().input<Frame>("frame", std::make_shared<const Frame>(run.world.frame(small_camera(), look({0, 0, 0}), kSigma, 0, false)));
  CHECK_THROWS_AS(run.harness().tick(), InternalError);
}

TEST_CASE("map.points starts with no points where the first frame says") {
  Harness h(builtin(), "map.points", "{particles: 3, spacing: 5 cm}");
  const Frame frame = BoxWorld().frame(small_camera(), look({1, 0, 0}), kSigma, 4, false);
  h.input<Frame>("frame", std::make_shared<const Frame>(frame));
  h.tick();
  REQUIRE(h.belief().size() == 3);
  CHECK(static_cast<const PointMap&>(*h.belief().map[0]).spacing_m() == 0.05);
  CHECK(h.belief().map[0]->kind() == "points");
  CHECK(h.belief().map[0]->stats().vertices == 0);
  CHECK(h.belief().pose[2].isApprox(look({1, 0, 0})));
  CHECK_THROWS_AS(Harness(builtin(), "map.points", "{spacing: 0}"), ConfigError);
}
