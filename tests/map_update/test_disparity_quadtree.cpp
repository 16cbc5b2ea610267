#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/disparity_quadtree.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// Depth of a slanted plane; its disparity is linear over the image.
float slanted(int x, int y) {
  return 1.0f / (0.4f + 0.002f * static_cast<float>(x) - 0.001f * static_cast<float>(y));
}

DisparityImage image_of(const std::function<float(int, int)>& depth, int smooth = 0) {
  const Frame frame = frame_of(depth);
  const Prediction nothing = prediction_of([](int, int) { return NAN; });
  UpdateView view;
  view.build(frame, nothing, test::one_worker());
  DisparityImage image;
  image.build(view, std::vector<std::uint8_t>(frame.depth.size(), 1), smooth, 3);
  return image;
}

std::vector<std::uint8_t> everywhere(const DisparityImage& image) {
  return std::vector<std::uint8_t>(image.value.size(), 1);
}

/// By cell of leaf_min pixels: the size of the leaf that covers it, 0 where there is none. Checks that no two overlap.
std::vector<int> sizes_by_cell(const DisparityImage& image, const std::vector<Leaf>& leaves, int unit, int& cols) {
  cols = (image.cols - 2) / unit + 1;
  const int rows = (image.rows - 2) / unit + 1;
  std::vector<int> size(static_cast<std::size_t>(cols * rows), 0);
  for (const auto& leaf : leaves)
    for (int v = leaf.y / unit; v < std::min((leaf.y + leaf.size) / unit, rows); ++v)
      for (int u = leaf.x / unit; u < std::min((leaf.x + leaf.size) / unit, cols); ++u) {
        auto& cell = size[static_cast<std::size_t>(v * cols + u)];
        REQUIRE(cell == 0);
        cell = leaf.size;
      }
  return size;
}

}  // namespace

TEST_CASE("a slanted plane is covered by the largest leaves, and their planes are exact in disparity") {
  const auto image = image_of(slanted);
  const auto leaves = disparity_leaves(image, everywhere(image), {});
  int cols = 0;
  for (int size : sizes_by_cell(image, leaves, 2, cols)) CHECK(size == 16);
  for (const auto& leaf : leaves)
    for (int k = 0; k < 4; ++k) {
      const int x = leaf.x + (k & 1) * leaf.size, y = leaf.y + (k >> 1) * leaf.size;
      CHECK(leaf.disparity(x, y) == Approx(0.4 + 0.002 * x - 0.001 * y).margin(1e-5));
    }
}

TEST_CASE("smoothing by symmetric pairs leaves a slanted plane and a depth jump as they are") {
  const auto plane = image_of(slanted, 2), raw = image_of(slanted);
  for (std::size_t p = 0; p < raw.value.size(); ++p) CHECK(plane.value[p] == Approx(raw.value[p]).margin(1e-6));
  const auto step = image_of([](int x, int) { return x < 41 ? 1.0f : 2.0f; }, 2);
  for (std::size_t p = 0; p < step.value.size(); ++p)
    CHECK(step.value[p] == Approx(p % 80 < 41 ? 1.0 : 0.5).margin(1e-6));
}

TEST_CASE("smoothing lowers the noise of a plane") {
  Rng rng(1, 0, 0, purpose_key("noise"));
  const auto noisy = [&](int, int) { return 2.0f + 0.004f * static_cast<float>(rng.normal()); };
  const auto image = image_of(noisy, 2);
  double squares = 0;
  for (float d : image.value) squares += (d - 0.5) * (d - 0.5);
  CHECK(std::sqrt(squares / static_cast<double>(image.value.size())) < 0.3 * 0.004 / 4);  // 0.004 m at 2 m is 0.001 1/m
}

TEST_CASE("leaves stay on one side of a depth jump, get small beside it, and differ by a factor of two at most") {
  const auto image = image_of([](int x, int y) { return x + y < 71 ? 1.0f : 2.0f; });
  const auto leaves = disparity_leaves(image, everywhere(image), {});
  int cols = 0;
  const auto size = sizes_by_cell(image, leaves, 2, cols);
  for (const auto& leaf : leaves) {
    const int x1 = std::min(leaf.x + leaf.size, image.cols - 1), y1 = std::min(leaf.y + leaf.size, image.rows - 1);
    CHECK((leaf.x + leaf.y >= 71 || x1 + y1 < 71));
  }
  const auto has = [&](int s) {
    return std::any_of(leaves.begin(), leaves.end(), [s](const Leaf& l) { return l.size == s; });
  };
  CHECK((has(2) && has(4) && has(8)));
  for (std::size_t c = 0; c < size.size(); ++c)
    for (std::size_t other : {c + 1, c + static_cast<std::size_t>(cols)}) {
      if (other >= size.size() || (other == c + 1 && other % static_cast<std::size_t>(cols) == 0)) continue;
      if (size[c] && size[other]) CHECK((size[c] <= 2 * size[other] && size[other] <= 2 * size[c]));
    }
}

TEST_CASE("leaves are made only where they are wanted and mostly measured") {
  const auto image = image_of([](int x, int) { return x < 40 ? 1.5f : NAN; });
  auto wanted = everywhere(image);
  for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p] = p / 80 < 24;
  for (const auto& leaf : disparity_leaves(image, wanted, {})) {
    CHECK(leaf.y <= 24);
    CHECK(leaf.x < 40);
  }
}

TEST_CASE("a corner at a jump belongs to the surface that was measured there") {
  const auto image = image_of([](int x, int) { return x < 41 ? 1.0f : 2.0f; });
  const auto corners = leaf_corners(image, disparity_leaves(image, everywhere(image), {}), 3);
  CHECK(corners.size() > 60);
  for (const auto& c : corners) CHECK(c.disparity == Approx(c.x < 41 ? 1.0 : 0.5).margin(1e-4));
}
