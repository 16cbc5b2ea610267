#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"
#include "framework/roles/frame_conditioning.hpp"

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ppm::Frame image_5x3() {
  ppm::Frame f;
  f.index = 4;
  f.stamp_s = 0.5;
  f.camera = {5, 3, 10, 12, 2, 1};
  for (int i = 0; i < 15; ++i) {
    f.depth.push_back(1.0f + 0.1f * static_cast<float>(i));
    for (int c = 0; c < 3; ++c) f.color.push_back(static_cast<std::uint8_t>(3 * i + c));
  }
  return f;
}

}  // namespace

TEST_CASE("decimation picks pixels from (0, 0) on, of depth, noise, confidence and colour") {
  auto image = image_5x3();
  for (int i = 0; i < 15; ++i) image.confidence.push_back(static_cast<float>(100 + i));
  const auto out = ppm::FrameConditioning().apply(image, 2);
  CHECK(out.index == 4);
  CHECK(out.stamp_s == 0.5);
  CHECK(out.camera == image.camera.decimated(2));
  CHECK(out.depth == std::vector<float>{image.depth[0], image.depth[2], image.depth[4], image.depth[10],
                                        image.depth[12], image.depth[14]});
  CHECK(std::vector<std::uint8_t>(out.color.begin() + 9, out.color.begin() + 12) ==
        std::vector<std::uint8_t>{30, 31, 32});
  CHECK(out.color.size() == 18);
  CHECK(out.confidence == std::vector<float>{100, 102, 104, 110, 112, 114});
}

TEST_CASE("noise across the line of sight counts in the pixels that stay") {
  ppm::FrameConditioning conditioning;
  CHECK(conditioning.apply(image_5x3(), 1).lateral_px == 0.5f);
  conditioning.sigma_lateral = 0.8;
  CHECK(conditioning.apply(image_5x3(), 2).lateral_px == 0.4f);
  CHECK(conditioning.apply(image_5x3(), 2).confidence.empty());
}

TEST_CASE("depth that is not finite or out of range is no return") {
  auto image = image_5x3();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> bad{kNan, inf, -inf, 0.0f, -1.0f, 0.29f, 10.1f};
  std::copy(bad.begin(), bad.end(), image.depth.begin());
  image.depth[7] = 10.0f;
  const auto out = ppm::FrameConditioning().apply(image, 1);
  for (int i = 0; i < 7; ++i) {
    CHECK_FALSE(out.valid(i));
    CHECK(std::isnan(out.sigma[static_cast<std::size_t>(i)]));
  }
  for (int i = 7; i < 15; ++i) CHECK(out.valid(i));
}

TEST_CASE("noise is the model's where the source gives none, and the source's where it does") {
  ppm::FrameConditioning conditioning;
  CHECK(conditioning.sigma(0.4) == Approx(0.0012));
  CHECK(conditioning.sigma(2.4) == Approx(0.0012 + 0.0019 * 4));
  auto image = image_5x3();
  CHECK(conditioning.apply(image, 1).sigma[3] == Approx(conditioning.sigma(1.3)));
  image.sigma.assign(15, 0.5f);
  image.depth[1] = kNan;
  const auto out = conditioning.apply(image, 1);
  CHECK(out.sigma[0] == 0.5f);
  CHECK(std::isnan(out.sigma[1]));
}

TEST_CASE("the camera is put right before all else: principal point in pixels as read, depth before its limits") {
  ppm::FrameConditioning conditioning;
  conditioning.correction = {.focal_scale = 0.9, .cx_shift = 1, .cy_shift = -0.5, .depth_factor = 1.1, .depth_bend = 0.1,
                             .depth_bend_x = 0.2, .depth_bend_y = -0.1, .depth_bend_radial = 0.05};
  conditioning.max_range_m = 2.5;
  auto image = image_5x3();
  const auto modelled = conditioning.apply(image, 2);
  CHECK(modelled.camera == ppm::Camera{5, 3, 9, 10.8, 3, 0.5}.decimated(2));
  // Pixel (2, 0) as read, on the ray (-1/9, -0.5/10.8): z = 1.2.
  const double X = -1 / 9.0, Y = -0.5 / 10.8, b = 0.1 + 0.2 * X - 0.1 * Y + 0.05 * (X * X + Y * Y);
  CHECK(modelled.depth[1] == Approx(1.1 / (1 / 1.2 - b)));
  CHECK(modelled.sigma[1] == Approx(conditioning.sigma(modelled.depth[1])));
  CHECK(modelled.valid(3));
  CHECK_FALSE(modelled.valid(5));  // 2.4 m as read, beyond the limit as corrected
  image.sigma.assign(15, 0.01f);
  CHECK(conditioning.apply(image, 2).sigma[1] == Approx(0.01 * 1.1 / std::pow(1 - 1.2 * b, 2)));
}

TEST_CASE("depths that a correction takes beyond infinity are no return") {
  const ppm::CameraCorrection correction{.depth_bend = 0.2};
  CHECK(correction.depth(4, 0.2) == Approx(20));
  CHECK(std::isnan(correction.depth(5.1, 0.2)));
}

TEST_CASE("an image whose arrays do not fit its camera is a bug that is told") {
  auto image = image_5x3();
  image.depth.pop_back();
  CHECK_THROWS_AS(ppm::FrameConditioning().apply(image, 1), ppm::InternalError);
}
