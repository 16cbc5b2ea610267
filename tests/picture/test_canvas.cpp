#include <catch2/catch.hpp>

#include "modules/maps/picture/canvas.hpp"

using namespace ppm;

namespace {

const Camera kCamera{64, 48, 50, 50, 31.5, 23.5};
const Color kRed(1, 0, 0), kGreen(0, 1, 0), kBlack(0, 0, 0), kWhite(1, 1, 1);

// A square across the optical axis at depth z, seen from its front by a camera at the origin.
void square(Canvas& canvas, float x0, float x1, float y0, float y1, float z, const Color& color) {
  const ColoredPoint a{{x0, y0, z}, color}, b{{x1, y0, z}, color}, c{{x1, y1, z}, color}, d{{x0, y1, z}, color};
  canvas.triangle({a, c, b});
  canvas.triangle({a, d, c});
}
Color pixel(const RgbImage& image, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * image.cols + x);
  return Color(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]) / 255.0f;
}

}  // namespace

TEST_CASE("a triangle lands where the camera projects it") {
  // Depth 2 m: 0.04 m a pixel. Pixels 10.5 to 20.5 and 5.5 to 15.5 in image coordinates.
  Canvas canvas(kCamera, Pose::Identity(), 1);
  auto x = [](double px) { return static_cast<float>((px - 31.5) / 50 * 2); };
  auto y = [](double px) { return static_cast<float>((px - 23.5) / 50 * 2); };
  square(canvas, x(10.5), x(20.5), y(5.5), y(15.5), 2, kRed);
  const auto image = canvas.resolve(kBlack, kBlack);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) {
      const bool inside = u > 10 && u <= 20 && v > 5 && v <= 15;
      INFO(u << " " << v);
      REQUIRE(pixel(image, u, v) == (inside ? kRed : kBlack));
      REQUIRE(canvas.depth(u, v) == (inside ? 2.0f : Canvas::kNothing));
    }
}

TEST_CASE("the camera's pose moves the picture") {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(1, 2, -3);
  Canvas canvas(kCamera, pose, 1);
  square(canvas, 0.9f, 1.1f, 1.9f, 2.1f, 0, kRed);
  CHECK(canvas.depth(32, 24) == Approx(3));
  CHECK(canvas.depth(5, 5) == Canvas::kNothing);
}

TEST_CASE("nearer surfaces hide farther ones in any order of drawing") {
  for (const bool near_first : {true, false}) {
    Canvas canvas(kCamera, Pose::Identity(), 1);
    if (near_first) square(canvas, -0.1f, 0.1f, -0.1f, 0.1f, 1, kRed);
    square(canvas, -1, 1, -1, 1, 2, kGreen);
    if (!near_first) square(canvas, -0.1f, 0.1f, -0.1f, 0.1f, 1, kRed);
    const auto image = canvas.resolve(kBlack, kBlack);
    CHECK(pixel(image, 32, 24) == kRed);
    CHECK(pixel(image, 10, 10) == kGreen);
  }
}

TEST_CASE("the back of a triangle is invisible") {
  Canvas canvas(kCamera, Pose::Identity(), 1);
  const ColoredPoint a{{-1, -1, 2}, kRed}, b{{1, -1, 2}, kRed}, c{{0, 1, 2}, kRed};
  canvas.triangle({a, b, c});
  CHECK(canvas.depth(32, 24) == Canvas::kNothing);
  canvas.triangle({a, c, b});
  CHECK(canvas.depth(32, 24) == 2);
}

TEST_CASE("a surface that passes the camera is cut, not lost") {
  Canvas canvas(kCamera, Pose::Identity(), 1);
  // A floor 1 m below (y points down), from 5 m behind to 50 m ahead.
  const ColoredPoint a{{-20, 1, -5}, kRed}, b{{20, 1, -5}, kRed}, c{{0, 1, 50}, kRed};
  canvas.triangle({a, b, c});
  canvas.triangle({a, c, b});
  const double ray_y = (40 - 23.5) / 50;
  CHECK(canvas.depth(32, 40) == Approx(1 / ray_y));
  CHECK(canvas.depth(32, 10) == Canvas::kNothing);
}

TEST_CASE("depth inside a slanted triangle is exact, colours are right in perspective") {
  Canvas canvas(kCamera, Pose::Identity(), 1);
  // The plane z = 2 + x; red falls from 1 at x = -1 to 0 at x = 1.
  const ColoredPoint a{{-1, -1, 1}, kRed}, b{{1, -1, 3}, kBlack}, c{{1, 1, 3}, kBlack}, d{{-1, 1, 1}, kRed};
  canvas.triangle({a, c, b});
  canvas.triangle({a, d, c});
  const auto image = canvas.resolve(kBlack, kBlack);
  for (int u : {12, 20, 32, 40}) {
    const double slope = (u - 31.5) / 50, x = 2 * slope / (1 - slope);
    CHECK(canvas.depth(u, 24) == Approx(2 + x));
    CHECK(pixel(image, u, 24).x() == Approx((1 - x) / 2).margin(0.003));
  }
}

TEST_CASE("half a pixel gives half its colour") {
  Canvas canvas(kCamera, Pose::Identity(), 4);
  auto x = [](double px) { return static_cast<float>((px - 31.5) / 50); };
  square(canvas, x(10), x(30), -0.4f, 0.4f, 1, kWhite);  // its left border runs through the middle of pixel 10
  const auto image = canvas.resolve(kBlack, kBlack);
  CHECK(pixel(image, 9, 24).x() == 0);
  CHECK(pixel(image, 10, 24).x() == Approx(0.5).margin(0.01));
  CHECK(pixel(image, 11, 24).x() == 1);
}

TEST_CASE("lines are as wide as asked, fade behind surfaces, and do not add up where they overlap") {
  Canvas canvas(kCamera, Pose::Identity(), 2);
  square(canvas, -2, 2, -0.6f, 0, 2, kBlack);  // covers the upper half, in front of the line's upper part
  const std::vector<Eigen::Vector3d> line{{0, -0.8, 4}, {0, 0.8, 4}};
  canvas.polylines({line, line}, {kWhite, 3, 0.8f, 0.4f});
  const auto image = canvas.resolve(kBlack, kBlack);
  CHECK(pixel(image, 31, 18).x() == Approx(0.4).margin(0.01));
  CHECK(pixel(image, 31, 28).x() == Approx(0.8).margin(0.01));
  double width = 0;
  for (int u = 0; u < 64; ++u) width += pixel(image, u, 28).x() / 0.8f;
  CHECK(width == Approx(3).margin(0.3));
}

TEST_CASE("a line over the bare background lets it through") {
  Canvas canvas(kCamera, Pose::Identity(), 1);
  canvas.polylines({{{-1, 0, 2}, {1, 0, 2}}}, {kRed, 4, 0.5f, 0});
  CHECK(pixel(canvas.resolve(kWhite, kWhite), 32, 23).isApprox(Color(1, 0.5f, 0.5f), 0.01f));
}

TEST_CASE("depth edges darken what is behind, nothing else") {
  Canvas canvas(kCamera, Pose::Identity(), 1);
  square(canvas, -2, 2, -2, 2, 4, kWhite);
  square(canvas, -0.2f, 0.2f, -0.2f, 0.2f, 2, kWhite);
  canvas.shade_depth_edges(10);
  const auto image = canvas.resolve(kBlack, kBlack);
  CHECK(pixel(image, 12, 5).x() == 1);     // far from the edge
  CHECK(pixel(image, 32, 24).x() == 1);    // in front
  CHECK(pixel(image, 37, 24).x() < 0.8f);  // beside the near square's border at 31.5 + 5
}
