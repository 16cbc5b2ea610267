#include <catch2/catch.hpp>

#include "modules/sources/color_registration.hpp"

using namespace ppm;

namespace {

/// 40 x 30 pixels at `depth`; red grows with the column, green with the row, by 5 a pixel.
Frame graded(float depth) {
  Frame f;
  f.camera = {40, 30, 40, 40, 20, 15};
  f.depth.assign(1200, depth);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int value : {5 * x, 5 * y, 7}) f.color.push_back(static_cast<std::uint8_t>(value));
  return f;
}

}  // namespace

TEST_CASE("a colour camera beside the depth camera: each pixel takes the colour that it saw of the measured point") {
  Frame f = graded(2.0f);
  register_color({36, {-0.1, 0.05, 0}}, f);
  // x' = 36 (x - 20) / 40 - 36 * 0.1 / 2 + 20, and so for y.
  for (int y : {5, 15, 22})
    for (int x : {8, 20, 33}) {
      const auto i = static_cast<std::size_t>(3 * (40 * y + x));
      CHECK(f.color[i] == Approx(5 * (0.9 * (x - 20) - 1.8 + 20)).margin(0.51));
      CHECK(f.color[i + 1] == Approx(5 * (0.9 * (y - 15) + 0.9 + 15)).margin(0.51));
      CHECK(f.color[i + 2] == 7);
    }
}

TEST_CASE("where nothing was measured the point at infinity counts, and beyond the colour image its border") {
  Frame f = graded(NAN);
  register_color({36, {-0.1, 0.05, 0}}, f);
  CHECK(f.color[3 * (40 * 15 + 30)] == Approx(5 * (0.9 * 10 + 20)).margin(0.51));
  Frame near = graded(0.1f);
  register_color({36, {-0.1, 0, 0}}, near);
  CHECK(near.color[3 * (40 * 15 + 10)] == 0);  // 36 * 0.1 / 0.1 = 36 px to the left: outside
}
