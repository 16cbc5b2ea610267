#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "modules/maps/picture/view_picture.hpp"

using namespace ppm;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kZoom = 160;  // of an image of 4 columns to 640

/// Four pixels: exact, 3 cm off, nothing predicted, nothing measured.
Frame measured() {
  Frame frame;
  frame.camera = {4, 1, 1e6, 1e6, 0, 0};
  frame.depth = {2, 2, 2, kNan};
  return frame;
}

Prediction predicted() {
  Prediction view;
  view.reset(measured().camera, 1, Pose::Identity());
  for (std::size_t i : {0, 1, 3}) {
    view.range[i] = i == 1 ? 2.03f : 2.0f;
    view.chunk[i] = 0;
    view.normal[3 * i + 2] = -1;
  }
  return view;
}

Color pixel(const RgbImage& image, int x, int y) {
  const auto* p = &image.rgb[3 * static_cast<std::size_t>(y * image.cols + x)];
  return Color(p[0], p[1], p[2]) / 255;
}

/// Number of colours in the place of an image pixel.
std::size_t colors_of(const RgbImage& image, int column) {
  std::set<std::array<float, 3>> colors;
  for (int y = 0; y < kZoom; ++y)
    for (int x = kZoom * column; x < kZoom * (column + 1); ++x) {
      const Color c = pixel(image, x, y);
      colors.insert({c.x(), c.y(), c.z()});
    }
  return colors.size();
}

bool is(const Color& a, const Color& b) {
  return (a - b).cwiseAbs().maxCoeff() < 0.01f;
}

}  // namespace

TEST_CASE("the error of a view: by colour, hatched where nothing is predicted, dark where nothing was measured") {
  const auto image = error_picture(measured(), predicted(), error_scale());
  CHECK(image.cols == 640);
  CHECK(image.rows > kZoom);
  CHECK(is(pixel(image, 10, 10), error_scale().color(0)));
  CHECK(is(pixel(image, kZoom + 10, 10), error_scale().color(0.03f)));
  CHECK(colors_of(image, 0) == 1);
  CHECK(colors_of(image, 2) == 2);
  CHECK(colors_of(image, 3) == 1);
  CHECK(pixel(image, 3 * kZoom + 10, 10).maxCoeff() < 0.3f);
}

TEST_CASE("the predicted surface is lit by its normals, the measured depth coloured") {
  auto view = predicted();
  view.normal[3] = 0.6f, view.normal[5] = -0.8f;  // turned away from the light
  const auto image = prediction_picture(view);
  CHECK(pixel(image, 10, 10).x() > pixel(image, kZoom + 10, 10).x());
  CHECK(colors_of(image, 2) == 2);
  CHECK(colors_of(image, 3) == 1);
  const auto scale = depth_scale(measured());
  const auto depth = depth_picture(measured(), scale);
  CHECK(is(pixel(depth, 10, 10), scale.color(2)));
  CHECK(pixel(depth, 3 * kZoom + 10, 10).maxCoeff() < 0.3f);
  CHECK(depth.rgb.size() == image.rgb.size());
}

TEST_CASE("an image without any depth has a scale all the same") {
  Frame frame = measured();
  frame.depth.assign(4, kNan);
  CHECK(depth_scale(frame).range().low < depth_scale(frame).range().high);
}
