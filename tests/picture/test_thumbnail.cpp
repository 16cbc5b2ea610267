#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/maps/picture/thumbnail.hpp"

using namespace ppm;

TEST_CASE("a picture comes back from its PNG, and shrinks to the means of its blocks") {
  RgbImage image{5, 4, {}};
  for (int k = 0; k < 5 * 4 * 3; ++k) image.rgb.push_back(static_cast<std::uint8_t>(4 * k));
  const auto again = from_png(to_png(image), "x.png");
  CHECK(again.cols == 5);
  CHECK(again.rgb == image.rgb);
  CHECK(shrunk(image, 5).rgb == image.rgb);
  const auto small = shrunk(image, 2);  // blocks of 3x3: one column, one row
  REQUIRE(small.cols == 1);
  REQUIRE(small.rows == 1);
  CHECK(small.rgb == std::vector<std::uint8_t>{72, 76, 80});  // the middle of the block, pixel (1, 1)
  CHECK_THROWS_AS(from_png("no picture", "x.png"), DataError);
}
