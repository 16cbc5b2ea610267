#include <catch2/catch.hpp>
#include <cmath>

#include "framework/slam/prediction.hpp"

TEST_CASE("a decimated camera sees the same rays through the pixels that it keeps") {
  const ppm::Camera camera{641, 480, 525, -520, 319.5, 239.5};
  const auto coarse = camera.decimated(4, 2, 1);
  CHECK(coarse.cols == 160);
  CHECK(coarse.rows == 120);
  CHECK((coarse.ray(7, 9) - camera.ray(2 + 4 * 7, 1 + 4 * 9)).norm() < 1e-12);
  CHECK(camera.decimated(1) == camera);
  CHECK(ppm::Camera{3, 3, 1, 1, 1, 1}.decimated(4, 3, 0).cols == 0);
  const Eigen::Vector3d p(0.3, -0.2, 2.0);
  const auto px = camera.project(p);
  CHECK((2.0 * camera.ray(px.x(), px.y()) - p).norm() < 1e-12);
}

TEST_CASE("a prediction is reset to misses") {
  ppm::Prediction p;
  p.reset({8, 6, 5, 5, 3.5, 2.5}, 2, ppm::Pose::Identity());
  REQUIRE(p.camera.cols == 4);
  REQUIRE(p.range.size() == 12);
  REQUIRE(p.normal.size() == 36);
  REQUIRE(p.bary.size() == 24);
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK_FALSE(p.hit(i));
    CHECK(p.range[i] == ppm::Prediction::kMiss);
  }
}

TEST_CASE("the expected range moves with the mean, against the cosine") {
  ppm::Prediction p;
  p.reset({1, 1, 1, 1, 0, 0}, 1, ppm::Pose::Identity());
  p.chunk[0] = 0;
  p.range[0] = 2;
  p.mean[0] = 0.1f;
  p.variance[0] = 0.01f;
  const auto d = p.direction(0);
  CHECK(d == Eigen::Vector3d(0, 0, 1));

  SECTION("seen at 60 degrees from the normal") {
    p.normal[0] = static_cast<float>(std::sqrt(0.75));
    p.normal[2] = -0.5f;
    // The plane (x - p) . n = 0.1 through p = (0, 0, 2), met by (0, 0, t): (t - 2) * -0.5 = 0.1.
    CHECK(p.expected_range(0, d) == Approx(1.8));
    CHECK(p.range_variance(0, d) == Approx(0.04));
  }
  SECTION("seen along the face, the offset stays bounded") {
    p.normal[0] = 1;
    CHECK(p.expected_range(0, d) == Approx(2 - 0.1 / ppm::Prediction::kMinCosine));
  }
}

TEST_CASE("a pool gives a dropped prediction out again, with its memory") {
  ppm::PredictionPool pool;
  auto a = pool.take();
  a->reset({4, 4, 1, 1, 0, 0}, 1, ppm::Pose::Identity());
  const auto* first = a.get();
  const auto b = pool.take();
  CHECK(b.get() != first);
  a.reset();
  const auto c = pool.take();
  CHECK(c.get() == first);
  CHECK(c->range.capacity() >= 16);
}

TEST_CASE("a prediction may outlive its pool") {
  std::shared_ptr<ppm::Prediction> kept;
  {
    ppm::PredictionPool pool;
    kept = pool.take();
  }
  kept->stride = 3;
  kept.reset();
}
