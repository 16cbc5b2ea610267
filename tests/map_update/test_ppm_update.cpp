#include <catch2/catch.hpp>

#include "tests/map_update/analytic_scene.hpp"
#include "tests/map_update/mapper.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSigma = 0.004;

AnalyticScene room_with_box() {
  AnalyticScene scene;
  scene.boxes.emplace_back(Eigen::Vector3d(-0.3, 0.4, 1.5), Eigen::Vector3d(0.3, 1.2, 2.1));
  return scene;
}

/// Share of the pixels that the map covers, and the largest error of the range among the given best share of them.
struct Agreement {
  double coverage, error_m;
};
Agreement agreement(Mapper& mapper, const AnalyticScene& scene, const Pose& pose, double share) {
  const Camera camera = small_camera();
  const auto seen = mapper.predict(camera, pose);
  std::vector<double> errors;
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x) {
      const auto p = static_cast<std::size_t>(y * camera.cols + x);
      if (!seen.hit(p)) continue;
      const Eigen::Vector3d ray = (pose.linear() * camera.ray(x, y)).normalized();
      const Eigen::Vector3d normal(seen.normal[3 * p], seen.normal[3 * p + 1], seen.normal[3 * p + 2]);
      const double range = seen.range[p] + seen.mean[p] / normal.dot(ray);
      errors.push_back(std::abs(range - scene.distance(pose.translation(), ray)));
    }
  std::sort(errors.begin(), errors.end());
  return {static_cast<double>(errors.size()) / camera.pixels(), errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))]};
}

}  // namespace

TEST_CASE("one image of a flat wall gives a few large faces that lie on it") {
  AnalyticScene scene;
  Mapper mapper;
  const Pose pose = look({0, 0, 1.8});  // nothing but the far wall in view
  mapper.add(scene.frame(small_camera(), pose, kSigma, 0, false));
  CHECK(mapper.map().stats().faces < 220);  // 80x60 pixels in leaves of 8 pixels: 160 triangles where no leaf is split
  const auto a = agreement(mapper, scene, pose, 1.0);
  CHECK(a.coverage > 0.94);  // all but the rays along the border
  CHECK(a.error_m < 1e-4);
}

TEST_CASE("views of a room from all sides make one map that agrees with the room") {
  const auto scene = room_with_box();
  Mapper mapper;
  for (int i = 0; i < 24; ++i) mapper.add(scene.frame(small_camera(), look({0.2, 0, 0.2}, 0.05 * i - 0.6, 0.1), kSigma, static_cast<std::uint32_t>(i), true));
  const auto a = agreement(mapper, scene, look({0.22, 0.02, 0.2}, 0.1, 0.12), 0.95);
  CHECK(a.coverage > 0.93);
  CHECK(a.error_m < 0.02);
}
