#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/texel_sample.hpp"

using namespace ppm;

namespace {

// One face with n divisions whose texel (i, j) has mean 1 + 2 i/n - 3 j/n, variance 5 + i/n + j/n.
struct Face {
  Geometry geometry;
  Texels texels;
  explicit Face(std::uint32_t n) {
    geometry.divisions = {static_cast<std::uint8_t>(n)};
    geometry.first_texel = {2};
    texels.mean.assign(2 + texel_count(n), NAN);
    texels.variance = texels.mean;
    texels.evidence.resize(1);
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(n),
                    v = static_cast<float>(j) / static_cast<float>(n);
        texels.mean[2 + texel_index(n, i, j)] = 1 + 2 * u - 3 * v;
        texels.variance[2 + texel_index(n, i, j)] = 5 + u + v;
      }
  }
};

}  // namespace

TEST_CASE("linear texels reproduce a linear texture, over the face and its border") {
  const auto n = static_cast<std::uint32_t>(GENERATE(1, 2, 3, 7, 64));
  const Face face(n);
  Rng rng(1, 0, 0, n);
  for (int k = 0; k < 500; ++k) {
    float u = static_cast<float>(rng.uniform()), v = static_cast<float>(rng.uniform());
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    if (k % 5 == 0) v = 1 - u;  // on the far edge
    if (k % 7 == 0) u = 0;
    const auto s = linear_sample(face.geometry, face.texels, 0, u, v);
    CHECK(s.mean == Approx(1 + 2 * u - 3 * v).margin(1e-4));
    CHECK(s.variance == Approx(5 + u + v).margin(1e-4));
  }
}

TEST_CASE("texels at and beyond the corners, as rounding gives them") {
  const Face face(4);
  for (auto [u, v] : {std::pair{0.f, 0.f},
                      {1.f, 0.f},
                      {0.f, 1.f},
                      {-1e-6f, 0.5f},
                      {0.5f, 0.500001f},
                      {1.000001f, 0.f},
                      {1.f, 1e-6f}}) {
    CAPTURE(u, v);
    CHECK(linear_sample(face.geometry, face.texels, 0, u, v).mean == Approx(1 + 2 * u - 3 * v).margin(1e-4));
    CHECK(nearest_sample(face.geometry, face.texels, 0, u, v).mean == Approx(1 + 2 * u - 3 * v).margin(0.6));
  }
}
