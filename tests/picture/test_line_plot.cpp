#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/picture/line_plot.hpp"

using namespace ppm;

namespace {

/// Pixels that are about of a colour, in a part of the picture.
std::size_t count(const RgbImage& image, const Color& color, int row0, int row1, int col0, int col1) {
  const auto bytes = to_bytes(color);
  std::size_t n = 0;
  for (int y = row0; y < row1; ++y)
    for (int x = col0; x < col1; ++x) {
      const auto* p = &image.rgb[3 * static_cast<std::size_t>(y * image.cols + x)];
      int off = 0;
      for (std::size_t k = 0; k < 3; ++k) off += std::abs(int(p[k]) - int(bytes[k]));
      n += off < 30;
    }
  return n;
}

const Color kCurve(0.09f, 0.36f, 0.62f), kShade(1.0f, 0.85f, 0.82f);

}  // namespace

TEST_CASE("round values are multiples of 1, 2 or 5 times a power of ten within the range") {
  CHECK(round_values(0, 1, 4) == std::vector<double>{0, 0.5, 1});
  const auto values = round_values(-0.013, 0.021, 4);
  REQUIRE(values.size() == 4);
  CHECK_FALSE(std::signbit(values[1]));
  CHECK(values.front() == Approx(-0.01));
  CHECK(values.back() == Approx(0.02));
  CHECK(round_values(100, 999, 10).front() == 100);
  CHECK(round_values(100, 999, 10).back() == 900);
}

TEST_CASE("a line rises from the lower left to the upper right of its panel, and no other") {
  PlotSettings settings;
  settings.cols = 400;
  std::vector<Eigen::Vector2d> rise, flat;
  for (int i = 0; i <= 100; ++i) {
    rise.emplace_back(i, i);
    flat.emplace_back(i, 3);
  }
  const auto image = line_plot({{"rise", rise}, {"flat", flat}}, {{40, 60}}, settings);
  CHECK(image.cols == 400);
  CHECK(image.rows == 2 * settings.panel_rows + 30);
  CHECK(count(image, kCurve, 90, 130, 76, 150) > 20);
  CHECK(count(image, kCurve, 20, 60, 320, 400) > 20);
  CHECK(count(image, kCurve, 20, 60, 76, 150) == 0);
  CHECK(count(image, kCurve, 195, 215, 76, 390) > 200);  // the middle of the second panel
  CHECK(count(image, kShade, 130, 260, 200, 260) > 1000);
  CHECK(count(image, kShade, 0, 290, 76, 180) == 0);
}

TEST_CASE("lines without points, and of one, are drawn as what they are") {
  const auto image = line_plot({{"none", {}}, {"one", {{5, 0}}}}, {}, {});
  CHECK(image.rows == 290);
  CHECK_THROWS_AS(line_plot({}, {}, {}), InternalError);
}
