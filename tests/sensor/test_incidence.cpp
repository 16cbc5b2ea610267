#include <catch2/catch.hpp>

#include "modules/sensor/incidence.hpp"
#include "tests/support/plane_image.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kBaseline = 0.02;  // two pixels

}  // namespace

TEST_CASE("the angle of incidence on a plane is exact in every pixel") {
  const double fy = GENERATE(110.0, -110.0);
  const Camera camera{32, 24, 100, fy, 15.5, 11.5};
  const Eigen::Vector3d normal = Eigen::Vector3d(0.6, -0.3, 0.5).normalized();
  const Frame image = plane_image(camera, normal, 1.5);
  const auto cosine = incidence_cosine(image, kBaseline);
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x)
      CHECK(cosine[static_cast<std::size_t>(32 * y + x)] ==
            Approx(std::abs(normal.dot(camera.ray(x, y).normalized()))).epsilon(2e-3));
}

TEST_CASE("beside a depth jump the angle is that of the pixel's own surface") {
  const Camera camera{32, 24, 100, 100, 15.5, 11.5};
  Frame image = plane_image(camera, {0, 0, 1}, 2);
  const Frame near = plane_image(camera, {0, 0, 1}, 1);
  for (std::size_t p = 0; p < image.depth.size(); ++p)
    if (p % 32 < 10) image.depth[p] = near.depth[p];
  const auto cosine = incidence_cosine(image, kBaseline);
  for (int x = 0; x < 32; ++x)
    CHECK(cosine[static_cast<std::size_t>(32 * 12 + x)] == Approx(1 / camera.ray(x, 12).norm()).epsilon(1e-3));
}

TEST_CASE("without neighbours the angle is not known") {
  const Camera camera{32, 24, 100, 100, 15.5, 11.5};
  Frame image = plane_image(camera, {0, 0, 1}, 2);
  for (int x : {8, 12}) image.depth[static_cast<std::size_t>(32 * 12 + x)] = kNoReturn;
  const auto cosine = incidence_cosine(image, kBaseline);
  CHECK(std::isnan(cosine[32 * 12 + 10]));
  CHECK(std::isnan(cosine[32 * 12 + 8]));
  CHECK(cosine[32 * 12 + 11] > 0.9);
}
