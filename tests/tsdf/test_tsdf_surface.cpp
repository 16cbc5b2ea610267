// Rays through signed distances against the room that they were made of.
#include <catch2/catch.hpp>

#include "modules/maps/tsdf/tsdf_surface.hpp"
#include "tests/support/box_images.hpp"
#include "tests/support/plane_image.hpp"

using namespace ppm;

namespace {

TsdfMap box_map(double voxel_m) {
  TsdfMap map({voxel_m, 4 * voxel_m});
  for (const auto& view : test::box_views()) map.integrate(test::box_image(test::box_camera(), view), view, 0);
  return map;
}

}  // namespace

TEST_CASE("a wall seen straight on is found to a fraction of a voxel, with its normal") {
  // fy < 0 as in ICL-NUIM, too: the library's projection is the same.
  const double fy = GENERATE(100.0, -100.0);
  const Camera camera{80, 60, 100, fy, 39.5, 29.5};
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.2, 1).normalized();
  TsdfMap map({0.02, 0.08});
  for (int i = 0; i < 3; ++i) map.integrate(test::plane_image(camera, normal, 1.5), Pose::Identity(), 0);
  TsdfSurface surface(map);
  int found = 0;
  for (int y = 8; y < camera.rows - 8; y += 4)
    for (int x = 8; x < camera.cols - 8; x += 4) {
      const Eigen::Vector3d direction = camera.ray(x, y).normalized();
      const auto point = surface.look(Eigen::Vector3d::Zero(), direction, 10);
      if (!point) continue;
      ++found;
      CHECK(point->range_m == Approx(1.5 / normal.dot(direction)).margin(0.006));
      CHECK(-point->normal.cast<double>().dot(normal) > 0.98);
      CHECK(point->weight == 3);
    }
  CHECK(found > 150);
}

TEST_CASE("a room is seen as it is, from a place that it was not mapped from") {
  const double voxel_m = GENERATE(0.02, 0.04);
  const auto map = box_map(voxel_m);
  TsdfSurface surface(map);
  const auto camera = test::box_camera();
  Pose T = test::box_views()[1];
  T.translation() += Eigen::Vector3d(-0.2, 0.1, 0.15);
  std::vector<double> errors;
  for (int y = 12; y < 48; y += 2)
    for (int x = 8; x < 72; x += 2) {
      const Eigen::Vector3d direction = (T.linear() * camera.ray(x, y)).normalized();
      if (const auto point = surface.look(T.translation(), direction, 10))
        errors.push_back(std::abs(point->range_m - test::box_range(T.translation(), direction)));
    }
  REQUIRE(errors.size() > 500);
  std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
  CHECK(errors[errors.size() / 2] < 0.2 * voxel_m);
}

TEST_CASE("rays find the zero that dense sampling of the distance finds") {
  const auto map = box_map(0.04);
  TsdfSurface surface(map);
  const auto camera = test::box_camera();
  const auto view = test::box_views()[0];
  const Eigen::Vector3d origin = view.translation();
  int compared = 0;
  for (int y = 10; y < 50; y += 4)
    for (int x = 10; x < 70; x += 4) {
      const Eigen::Vector3d direction = (view.linear() * camera.ray(x, y)).normalized();
      const auto point = surface.look(origin, direction, 5);
      std::optional<double> before;
      double zero = 0;
      constexpr double kStep = 1e-3;
      for (double s = 0; s < 5 && zero == 0; s += kStep) {
        const auto here = surface.distance(origin + s * direction);
        if (here && before && *before > 0 && *here <= 0) zero = s;
        before = here;
      }
      REQUIRE((zero > 0) == point.has_value());
      if (!point) continue;
      ++compared;
      CHECK(point->range_m == Approx(zero).margin(1.5 * kStep));
    }
  CHECK(compared > 100);
}

TEST_CASE("nothing is seen where nothing was mapped, nor a wall from behind") {
  const TsdfMap empty({0.02, 0.08});
  CHECK_FALSE(TsdfSurface(empty).look({0, 0, 0}, {0, 0, 1}, 10));
  TsdfMap map({0.02, 0.08});
  const Camera camera{80, 60, 100, 100, 39.5, 29.5};
  map.integrate(test::plane_image(camera, {0, 0, 1}, 1.5), Pose::Identity(), 0);
  CHECK(TsdfSurface(map).look({0, 0, 0}, {0, 0, 1}, 10));
  CHECK_FALSE(TsdfSurface(map).look({0, 0, 3}, {0, 0, -1}, 10));
  CHECK_FALSE(TsdfSurface(map).look({0, 0, 0}, {0, 0, 1}, 1));
}
