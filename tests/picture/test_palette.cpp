#include <algorithm>
#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/maps/picture/png_encoder.hpp"
#include "modules/maps/picture/thumbnail.hpp"

using namespace ppm;

namespace {

RgbImage gray(const std::vector<int>& values) {
  RgbImage image{static_cast<int>(values.size()), 1, {}};
  for (const int v : values) image.rgb.insert(image.rgb.end(), 3, static_cast<std::uint8_t>(v));
  return image;
}

}  // namespace

TEST_CASE("a picture of few colours keeps them, and comes back from its PNG") {
  const RgbImage image{2, 2, {1, 2, 3, 200, 10, 0, 1, 2, 3, 0, 0, 255}};
  const auto small = in_palette(image, 3);
  CHECK(small.palette.size() == 3);
  CHECK(small.index[0] == small.index[2]);
  CHECK(from_png(to_png(small), "x.png").rgb == image.rgb);
  CHECK(in_palette(gray({7, 7}), 16).palette.size() == 1);
}

TEST_CASE("colours that lie near each other become their mean, by pixels") {
  const auto small = in_palette(gray({10, 10, 10, 14, 250, 100, 102}), 3);
  CHECK(from_png(to_png(small), "x.png").rgb == gray({11, 11, 11, 11, 250, 101, 101}).rgb);
}

TEST_CASE("a palette makes the file of a noisy picture several times smaller, and stays near it") {
  RgbImage image{160, 140, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < image.cols * image.rows; ++i) {
    state = 1664525 * state + 1013904223;
    const auto value = static_cast<std::uint8_t>(state >> 24);
    image.rgb.insert(image.rgb.end(), {value, static_cast<std::uint8_t>(value / 2), 30});
  }
  const auto bytes = to_png(in_palette(image, 16));
  CHECK(bytes.size() < 160 * 140 / 2 + 500);  // 4 bits a pixel
  const auto again = from_png(bytes, "x.png").rgb;
  int most = 0;
  for (std::size_t k = 0; k < again.size(); ++k) most = std::max(most, std::abs(again[k] - image.rgb[k]));
  CHECK(most <= 16);
}

TEST_CASE("a palette has 2 to 256 colours, a picture has pixels") {
  CHECK_THROWS_AS(in_palette(gray({1}), 1), InternalError);
  CHECK_THROWS_AS(in_palette(gray({1}), 257), InternalError);
  CHECK_THROWS_AS(in_palette(RgbImage{}, 16), InternalError);
}
