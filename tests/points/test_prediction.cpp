// Discs against closed forms.
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/map_update/box_world.hpp"
#include "tests/points/points.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// Of a plane through `middle`.
double plane_range(const Prediction& view, std::size_t pixel, const Eigen::Vector3d& middle, const Eigen::Vector3d& normal) {
  return normal.dot(middle - view.T_map_camera.translation()) / normal.dot(view.direction(pixel));
}

}  // namespace

TEST_CASE("points on a plane look like the plane, from both sides and with an image that points up") {
  const Eigen::Vector3f middle(0.1f, -0.2f, 2), normal = Eigen::Vector3f(0.3f, 0.2f, -1).normalized();
  const auto map = plane_of_points(middle, normal, 300, 0.02f);
  Camera upwards = small_camera();
  upwards.fy = -upwards.fy;
  PointView view;
  const Pose behind = look({0, 0, 4.5}, std::numbers::pi);
  for (const auto& [camera, pose] : {std::pair{small_camera(), look({0, 0, 0})}, {upwards, look({0.3, 0.1, 0.2}, 0.2, -0.1)}, {small_camera(), behind}}) {
    const Prediction seen = view.of(*map, camera, pose);
    int hits = 0;
    for (std::size_t p = 0; p < seen.range.size(); ++p) {
      if (!seen.hit(p)) continue;
      ++hits;
      CHECK(seen.range[p] == Approx(plane_range(seen, p, middle.cast<double>(), normal.cast<double>())).epsilon(1e-3));
      const Eigen::Vector3d n(seen.normal[3 * p], seen.normal[3 * p + 1], seen.normal[3 * p + 2]);
      CHECK(std::abs(n.dot(normal.cast<double>())) > 0.9999);
      CHECK(n.dot(seen.direction(p)) < 0);
      CHECK(seen.variance[p] == Approx(4e-6).epsilon(1e-3));
      CHECK(seen.mean[p] == 0);
    }
    CHECK(hits > camera.pixels() * 4 / 5);
  }
}

TEST_CASE("a disc covers the rays through it and no others, and the nearer one hides the farther") {
  auto map = with(std::make_shared<PointMap>(0.02), {surface_point({0, 0, 1}, {0, 0, -1}, 0.1f)});
  map = with(map, {surface_point({0.05f, 0, 2}, {0, 0, -1}, 0.4f)});
  const Prediction seen = PointView().of(*map, small_camera(), Pose::Identity());
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const auto p = static_cast<std::size_t>(80 * y + x);
      const Eigen::Vector3d ray = small_camera().ray(x, y);
      const double near = ray.head<2>().norm() - 0.1, far = (2 * ray.head<2>() - Eigen::Vector2d(0.05, 0)).norm() - 0.4;
      if (std::min(std::abs(near), std::abs(far)) < 1e-3) continue;  // at the rim
      if (near < 0)
        CHECK(seen.range[p] == Approx(ray.norm()));
      else if (far < 0)
        CHECK(seen.range[p] == Approx(2 * ray.norm()));
      else
        CHECK_FALSE(seen.hit(p));
    }
}

TEST_CASE("discs that overlap show their mean, the better known the more") {
  const auto map = with(std::make_shared<PointMap>(0.02), {surface_point({0, 0, 1}, {0, 0, -1}, 0.3f, 1, 0.002f),
                                                           surface_point({0, 0, 1.01f}, {0, 0, -1}, 0.3f, 1, 0.001f)});
  const Prediction seen = PointView().of(*map, Camera{3, 3, 100, 100, 1, 1}, Pose::Identity());
  CHECK(seen.range[4] == Approx(1.008).epsilon(1e-4));
  const Prediction alone = PointView("{blend: 5 mm}").of(*map, Camera{3, 3, 100, 100, 1, 1}, Pose::Identity());
  CHECK(alone.range[4] == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("a box of points looks like the box, but at its edges") {
  // The inside of a box: six planes of points.
  const Eigen::Vector3f half(1, 0.8f, 1.2f);
  auto map = std::make_shared<const PointMap>(0.02);
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      std::vector<SurfacePoint> points;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (float u = -half[a]; u <= half[a]; u += 0.02f)
        for (float v = -half[b]; v <= half[b]; v += 0.02f) {
          Eigen::Vector3f p;
          p[axis] = side * half[axis], p[a] = u, p[b] = v;
          points.push_back(surface_point(p, -side * Eigen::Vector3f::Unit(axis), 0.02f));
        }
      map = with(map, points);
    }
  BoxWorld box;
  box.room = {-half.cast<double>(), half.cast<double>()};
  PointView view;
  for (double yaw : {0.3, 1.9, 4.0}) {
    const Prediction seen = view.of(*map, small_camera(), look({0.1, -0.1, 0.2}, yaw, 0.2));
    std::vector<double> errors;
    for (std::size_t p = 0; p < seen.range.size(); ++p) {
      REQUIRE(seen.hit(p));
      errors.push_back(std::abs(seen.range[p] - box.distance(seen.T_map_camera.translation(), seen.direction(p))));
    }
    std::ranges::sort(errors);
    CHECK(errors[errors.size() / 2] < 1e-4);
    CHECK(errors[errors.size() * 9 / 10] < 0.01);
    CHECK(errors.back() < 0.06);
  }
}

TEST_CASE("rows of a view are the same bytes alone and together") {
  const auto map = plane_of_points({0, 0, 2}, {0.5f, 0.3f, -1}, 100, 0.03f);
  PointView view;
  const Prediction whole = view.of(*map, small_camera(), look({0, 0, 0}));
  Prediction parts;
  parts.reset(small_camera(), 1, look({0, 0, 0}));
  for (int first = 0; first < 60; first += 7) view.predictor().predict(*map, {first, std::min(first + 7, 60)}, parts, 0);
  CHECK(parts.range == whole.range);
  CHECK(parts.variance == whole.variance);
  CHECK(parts.normal == whole.normal);
  CHECK(parts.chunk == whole.chunk);
  CHECK(parts.face == whole.face);
}

TEST_CASE("points behind the camera and beside the image are not drawn") {
  const auto map = with(std::make_shared<PointMap>(0.02), {surface_point({0, 0, -1}, {0, 0, 1}, 0.1f),
                                                           surface_point({5, 0, 1}, {0, 0, -1}, 0.1f),
                                                           surface_point({0, 0, 0.02f}, {0, 0, -1}, 0.01f)});
  const Prediction seen = PointView().of(*map, small_camera(), Pose::Identity());
  for (std::size_t p = 0; p < seen.range.size(); ++p) CHECK_FALSE(seen.hit(p));
}
