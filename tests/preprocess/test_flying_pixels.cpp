#include <catch2/catch.hpp>

#include "modules/preprocess/depth_jumps.hpp"
#include "tests/preprocess/filtered.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{40, 30, 150, 150, 19.5, 14.5};
const std::string kModule = "preprocess.flying_pixels";

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kCamera.cols + x);
}

/// A wall at 3 m; before it, in columns 10 .. 19, a board at 1.5 m.
Frame board() {
  Frame image = plane_image(kCamera, {0, 0, 1}, 3);
  for (int y = 0; y < kCamera.rows; ++y)
    for (int x = 10; x < 20; ++x) image.depth[at(x, y)] = 1.5f;
  return image;
}

/// The columns of the row that lost their depth.
std::vector<int> columns(const Frame& in, const Frame& out, int row) {
  std::vector<int> found;
  for (const auto p : dropped(in, out))
    if (static_cast<int>(p) / kCamera.cols == row) found.push_back(static_cast<int>(p) % kCamera.cols);
  return found;
}

}  // namespace

TEST_CASE("a column that mixes near and far flies, the edges beside it stay") {
  Frame image = board();
  for (int y = 0; y < kCamera.rows; ++y) image.depth[at(9, y)] = 2.2f;
  const auto out = filtered(kModule, "{}", image);
  for (int y = 0; y < kCamera.rows; ++y) {
    CHECK(columns(image, *out, y) == std::vector<int>{9});
    CHECK(std::isnan(out->sigma[at(9, y)]));
    CHECK(out->sigma[at(8, y)] == image.sigma[at(8, y)]);
  }
}

TEST_CASE("a clean edge loses nothing, unless its pixels are asked for") {
  const Frame image = board();
  CHECK(dropped(image, *filtered(kModule, "{}", image)).empty());
  CHECK(columns(image, *filtered(kModule, "{edge: near}", image), 7) == std::vector<int>{10, 19});
  CHECK(columns(image, *filtered(kModule, "{edge: far}", image), 7) == std::vector<int>{9, 20});
  CHECK(columns(image, *filtered(kModule, "{edge: both}", image), 7) == std::vector<int>{9, 10, 19, 20});
}

TEST_CASE("a lone pixel flies, a thin thing does not") {
  Frame image = plane_image(kCamera, {0, 0, 1}, 3);
  image.depth[at(5, 5)] = 1.5f;
  for (int y = 3; y < 12; ++y) image.depth[at(25, y)] = 1.5f;  // a rod, one pixel wide
  image.depth[at(32, 20)] = 2.9f;
  for (int dx : {-1, 0, 1})
    for (int dy : {-1, 0, 1})
      if (dx != 0 || dy != 0) image.depth[at(32 + dx, 20 + dy)] = kNoReturn;  // nothing around it to lie on
  CHECK(dropped(image, *filtered(kModule, "{}", image)) == std::vector<std::size_t>{at(5, 5), at(32, 20)});
}

TEST_CASE("a slanted plane has no jumps up to the angle, and all over beyond") {
  const Workers workers(1);
  for (double degrees : {70.0, 78.0, 82.0, 86.0}) {
    const double tilt = degrees * EIGEN_PI / 180;
    const Camera narrow{9, 3, 1500, 1500, 4, 1};  // all rays within a sixth of a degree of the axis
    const Frame image = plane_image(narrow, {std::sin(tilt), 0, std::cos(tilt)}, 2 * std::cos(tilt), 1e-6f);
    const auto jumps = depth_jumps(image, {.angle_least = 10 * EIGEN_PI / 180}, workers);
    const Step expected = degrees < 80 ? Step::none : Step::closer;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 8; ++x) CHECK(jumps.right[static_cast<std::size_t>(9 * y + x)] == expected);
    CHECK(jumps.right[8] == Step::unknown);
    CHECK(jumps.down[0] == Step::none);
    CHECK(jumps.down[2 * 9] == Step::unknown);
  }
}

TEST_CASE("noise is no jump") {
  Frame image = plane_image(kCamera, {0, 0, 1}, 3, 0.1f);
  image.depth[at(9, 9)] = 3.4f;
  CHECK(dropped(image, *filtered(kModule, "{}", image)).empty());
  CHECK(dropped(image, *filtered(kModule, "{noise_sigmas: 2}", image)) == std::vector<std::size_t>{at(9, 9)});
}

TEST_CASE("flying pixels are the same for any number of threads and for an upside-down image") {
  Frame image = plane_image({640, 90, 500, 500, 319.5, 44.5}, {0, 0, 1}, 3);
  for (std::size_t p = 0; p < image.depth.size(); ++p) image.depth[p] -= p % 7 == 0 ? 1.0f : p % 5 == 0 ? 0.5f : 0.0f;
  const auto one = dropped(image, *filtered(kModule, "{}", image, 1));
  CHECK(one.size() > 100);
  CHECK(one == dropped(image, *filtered(kModule, "{}", image, 4)));
  image.camera.fy = -image.camera.fy;
  CHECK(one == dropped(image, *filtered(kModule, "{}", image)));
}

TEST_CASE("an unknown edge is refused") {
  CHECK_THROWS_AS(filtered(kModule, "{edge: nearer}", board()), ConfigError);
}
