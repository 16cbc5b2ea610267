#include <catch2/catch.hpp>

#include "framework/slam/pixel_block.hpp"

using namespace ppm;

namespace {

// A slanted plane with a step of 50 cm in the middle column.
Frame step_frame() {
  Frame frame;
  frame.camera = {32, 24, 30, -30, 15.5, 11.5};
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) {
      // depth z of the plane through (0, 0, 2) with normal (0.5, 0.3, -1), further by 0.5 m in the right half
      const Eigen::Vector3d ray = frame.camera.ray(x, y);
      const double z = 2.0 / (1 - 0.5 * ray.x() - 0.3 * ray.y());
      frame.depth.push_back(static_cast<float>(z + (x >= 16 ? 0.5 : 0.0)));
      frame.sigma.push_back(0.002f);
    }
  frame.depth[5] = frame.sigma[5] = NAN;
  return frame;
}

}  // namespace

TEST_CASE("measured pixels: grid, ranges along the ray, pixels without return left out") {
  const Frame frame = step_frame();
  const Camera predicted = frame.camera.decimated(2);
  PixelGrid grid;
  grid.step = 3;
  grid.first_x = 1;
  grid.first_y = 2;
  const auto m = measured_pixels(frame, predicted, 2, grid);
  REQUIRE(m.size() == 5 * 4);
  CHECK(m.pixel[0] == 2u * 16 + 1);
  CHECK(m.pixel[6] == 5u * 16 + 4);
  const Eigen::Vector3d ray = frame.camera.ray(8, 10);
  const float depth = frame.depth[10 * 32 + 8];
  CHECK(m.range[6] == Approx(depth * ray.norm()));
  CHECK(std::sqrt(m.variance[6]) == Approx(0.002 * ray.norm()));
  CHECK(m.lateral[6] == Approx(0.5 * depth / 30));
  CHECK(measured_pixels(frame, frame.camera, 1, {}).size() == 32 * 24 - 1);
}

TEST_CASE("measured pixels: depth jumps are left out, slopes are not") {
  const Frame frame = step_frame();
  PixelGrid grid;
  grid.jump_m = 0.1;
  const auto m = measured_pixels(frame, frame.camera, 1, grid);
  CHECK(m.size() == 32 * 24 - 1 - 2 * 24);
  for (auto p : m.pixel) CHECK((p % 32 < 15 || p % 32 > 16));
}

TEST_CASE("residuals compare with the described surface, not with the element") {
  const Frame frame = step_frame();
  Prediction p;
  p.reset(frame.camera, 1, Pose::Identity());
  const std::size_t pixel = 10 * 32 + 8;
  const Eigen::Vector3d d = frame.camera.ray(8, 10).normalized(), n = Eigen::Vector3d(0.5, 0.3, -1).normalized();
  p.chunk[pixel] = 0;
  p.range[pixel] = 1.9f;
  p.mean[pixel] = 0.01f;
  p.variance[pixel] = 1e-4f;
  for (std::size_t k = 0; k < 3; ++k) p.normal[3 * pixel + k] = static_cast<float>(n[static_cast<Eigen::Index>(k)]);
  PixelGrid grid;
  grid.step = 2;
  const auto m = measured_pixels(frame, frame.camera, 1, grid);
  ViewSamples expected;
  expected.resize(m.size() - 7);
  p.sample(std::span(m.pixel).subspan(7), expected);
  const PixelBlock block(frame, m, 7, expected);
  REQUIRE(block.size() == m.size() - 7);
  for (std::size_t i = 0; i < block.size(); ++i) {
    CHECK(block.range[i] == m.range[i + 7]);
    CHECK(block.source[i] == m.source[i + 7]);
    if (m.pixel[i + 7] != pixel) {
      CHECK_FALSE(block.hit(i));
      continue;
    }
    CHECK(block.residual(i) == Approx(m.range[i + 7] - p.expected_range(pixel, d)).margin(1e-6));
    CHECK(expected.variance[i] == Approx(p.range_variance(pixel, d)));
    CHECK(expected.cosine[i] == Approx(-n.dot(d)));
  }
}
