#include <catch2/catch.hpp>

#include "framework/slam/surface_patches.hpp"
#include "tests/support/plane_image.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{64, 48, 60, 60, 31.5, 23.5};
const Eigen::Vector3d kNormal(0.2, -0.3, 1);

}  // namespace

TEST_CASE("patches of a plane lie on it, with its normal") {
  const auto patches = surface_patches(plane_image(kCamera, kNormal, 2), 4);
  CHECK(patches.cols == 16);
  CHECK(patches.rows == 12);
  REQUIRE(patches.all.size() > 100);
  for (const auto& patch : patches.all) {
    const auto at = placed(patch, kCamera, {});
    CHECK(kNormal.dot(at.point) == Approx(2).margin(1e-5));
    CHECK((at.plane - kNormal / 2).norm() < 1e-4);
  }
  const auto& one = patches.all[50];
  CHECK(patches.around(one.x + 1.5, one.y - 1.5) == 50);
  CHECK(patches.around(-3, 10) == -1);
}

TEST_CASE("a patch that was measured by a wrong camera is placed by the right one") {
  const CameraCorrection wrong{.focal_scale = 1.05, .cx_shift = 2, .depth_factor = 0.98, .depth_bend = 0.01,
                               .depth_bend_x = 0.02};
  // What is measured of the plane: depths whose correction is the plane seen by the corrected camera.
  const Camera right = wrong.camera(kCamera);
  Frame frame = plane_image(right, kNormal, 2);
  frame.camera = kCamera;
  for (int y = 0, p = 0; y < kCamera.rows; ++y)
    for (int x = 0; x < kCamera.cols; ++x, ++p) {
      auto& z = frame.depth[static_cast<std::size_t>(p)];
      z = static_cast<float>(1 / (wrong.depth_factor / z + wrong.bend(right.ray(x, y))));
    }
  const auto patches = surface_patches(frame, 4);
  REQUIRE(patches.all.size() > 100);
  for (const auto& patch : patches.all) {
    const auto at = placed(patch, kCamera, wrong);
    CHECK(kNormal.dot(at.point) == Approx(2).margin(1e-5));
    CHECK((at.plane - kNormal / 2).norm() < 1e-3);
  }
}

TEST_CASE("where the surface is bent, grazing or not measured there is no patch") {
  Frame step = plane_image(kCamera, {0, 0, 1}, 2);
  for (std::size_t p = 0; p < step.depth.size(); ++p)
    if (p % 64 >= 32) step.depth[p] = 2.2f;
  const auto patches = surface_patches(step, 4);
  CHECK(patches.around(32, 24) == -1);
  CHECK(patches.around(14, 24) >= 0);
  CHECK(surface_patches(plane_image(kCamera, {0, 3, 1}, 2), 4).around(31, 23) == -1);
  Frame holes = plane_image(kCamera, {0, 0, 1}, 2);
  for (std::size_t p = 0; p < holes.depth.size(); p += 3) holes.depth[p] = kNoReturn;
  CHECK(surface_patches(holes, 4).all.empty());
}
