#include <catch2/catch.hpp>

#include "framework/core/rng.hpp"
#include "tests/preprocess/filtered.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{48, 36, 60, 60, 23.5, 17.5};
const std::string kModule = "preprocess.bilateral";

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kCamera.cols + x);
}

Frame noisy(Frame image, double sigma) {
  Rng rng(1, 2, 3, 4);
  for (auto& z : image.depth) z += static_cast<float>(sigma * rng.normal());
  image.sigma.assign(image.depth.size(), static_cast<float>(sigma));
  return image;
}

/// Root mean square of the difference from the truth, away from the image's border.
double error(const Frame& truth, const Frame& image) {
  double sum = 0;
  int n = 0;
  for (int y = 3; y < kCamera.rows - 3; ++y)
    for (int x = 3; x < kCamera.cols - 3; ++x, ++n) sum += std::pow(image.depth[at(x, y)] - truth.depth[at(x, y)], 2);
  return std::sqrt(sum / n);
}

}  // namespace

TEST_CASE("a slanted plane stays where it is, without its noise") {
  const Frame truth = plane_image(kCamera, {0.1, 0.06, 1}, 1.6, 0.02f);
  CHECK(error(truth, *filtered(kModule, "{sigma_depth: 3}", truth)) < 1e-4);
  const Frame image = noisy(truth, 0.01);
  const auto out = filtered(kModule, "{}", image);
  CHECK(error(truth, *out) < 0.7 * error(truth, image));
  CHECK(out->sigma == image.sigma);  // errors are shared now, not gone
}

TEST_CASE("an edge stays sharp") {
  Frame truth = plane_image(kCamera, {0, 0, 1}, 2);
  for (std::size_t p = 0; p < truth.depth.size(); ++p)
    if (p % 48 < 20) truth.depth[p] = 1.5f;
  const Frame image = noisy(truth, 0.01);
  const auto out = filtered(kModule, "{}", image);
  for (std::size_t p = 0; p < truth.depth.size(); ++p) CHECK(std::abs(out->depth[p] - truth.depth[p]) < 0.05f);
  CHECK(error(truth, *out) < 0.7 * error(truth, image));
}

TEST_CASE("pixels without a return stay so and count for nothing") {
  Frame image = plane_image(kCamera, {0, 0, 1}, 2, 0.01f);
  for (int y = 0; y < kCamera.rows; ++y)
    for (int x = 0; x < kCamera.cols; ++x)
      if ((x + y) % 3 == 0) image.depth[at(x, y)] = image.sigma[at(x, y)] = kNoReturn;
  const auto out = filtered(kModule, "{radius: 3, sigma_image: 2}", image);
  for (std::size_t p = 0; p < image.depth.size(); ++p) {
    CHECK(std::isnan(out->depth[p]) == std::isnan(image.depth[p]));
    if (!std::isnan(out->depth[p])) CHECK(out->depth[p] == Approx(2));
  }
}

TEST_CASE("smoothing is the same for any number of threads") {
  const Frame image = noisy(plane_image({640, 120, 500, 500, 319.5, 59.5}, {0.1, 0, 1}, 2), 0.01);
  CHECK(filtered(kModule, "{}", image, 1)->depth == filtered(kModule, "{}", image, 4)->depth);
}

TEST_CASE("a neighbourhood of nothing is refused") {
  CHECK_THROWS_AS(filtered(kModule, "{radius: 0}", noisy(plane_image(kCamera, {0, 0, 1}, 2), 0.01)), ConfigError);
}
