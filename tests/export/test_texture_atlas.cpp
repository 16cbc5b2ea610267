#include <catch2/catch.hpp>

#include "framework/core/rng.hpp"
#include "modules/maps/export/texture_atlas.hpp"

using namespace ppm;

namespace {

/// What a viewer shows at a place in a texture: the four pixels around it, mixed.
Color bilinear(const RgbImage& image, const Eigen::Vector2f& uv) {
  const float x = uv.x() * static_cast<float>(image.cols) - 0.5f, y = uv.y() * static_cast<float>(image.rows) - 0.5f;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
  auto pixel = [&](int c, int r) {
    c = std::clamp(c, 0, image.cols - 1);
    r = std::clamp(r, 0, image.rows - 1);
    const auto* p = &image.rgb[3 * static_cast<std::size_t>(r * image.cols + c)];
    return Color(Color(p[0], p[1], p[2]) / 255);
  };
  return (1 - b) * ((1 - a) * pixel(i, j) + a * pixel(i + 1, j)) +
         b * ((1 - a) * pixel(i, j + 1) + a * pixel(i + 1, j + 1));
}

std::vector<std::uint8_t> random_divisions(std::size_t count, Rng& rng) {
  std::vector<std::uint8_t> divisions;
  for (std::size_t f = 0; f < count; ++f) divisions.push_back(static_cast<std::uint8_t>(1 + rng.below(f % 7 == 0 ? 30 : 6)));
  return divisions;
}

}  // namespace

TEST_CASE("no face's texture takes colour from another's, wherever it is sampled") {
  Rng rng(1, 0, 0, 0);
  for (const std::size_t faces : {1, 2, 3, 80}) {
    const auto divisions = random_divisions(faces, rng);
    const TextureAtlas atlas(divisions);
    std::vector<Color> texels;
    std::vector<Color> own;
    for (const auto n : divisions) {
      own.emplace_back(static_cast<float>(rng.below(256)) / 255, static_cast<float>(rng.below(256)) / 255, 0.2f);
      texels.insert(texels.end(), texel_count(n), own.back());
    }
    const RgbImage image = atlas.paint(texels);
    REQUIRE(image.rgb.size() == 3 * static_cast<std::size_t>(image.cols * image.rows));
    for (std::size_t f = 0; f < faces; ++f) {
      const auto uv = atlas.uv(f);
      for (int k = 0; k < 60; ++k) {
        // Corners and sides too: weights of zero are drawn often.
        Eigen::Vector3f w(static_cast<float>(rng.below(4)), static_cast<float>(rng.below(4)),
                          static_cast<float>(rng.uniform()));
        w /= std::max(w.sum(), 1e-6f);
        if (w.sum() < 0.5f) w = {1, 0, 0};
        const Color seen = bilinear(image, w[0] * uv[0] + w[1] * uv[1] + w[2] * uv[2]);
        REQUIRE((seen - own[f]).cwiseAbs().maxCoeff() < 0.004f);
      }
    }
  }
}

TEST_CASE("what is linear over a face is linear in its texture") {
  Rng rng(2, 0, 0, 0);
  const auto divisions = random_divisions(30, rng);
  const TextureAtlas atlas(divisions);
  auto value = [](float u, float v) { return Color(0.2f + 0.5f * u, 0.8f - 0.4f * v, 0.3f + 0.2f * u + 0.3f * v); };
  std::vector<Color> texels;
  for (const std::uint32_t n : divisions)
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j)
        texels.push_back(value(static_cast<float>(i) / static_cast<float>(n), static_cast<float>(j) / static_cast<float>(n)));
  const RgbImage image = atlas.paint(texels);
  for (std::size_t f = 0; f < divisions.size(); ++f) {
    const auto uv = atlas.uv(f);
    for (int k = 0; k < 60; ++k) {
      float u = static_cast<float>(rng.uniform()), v = static_cast<float>(rng.uniform());
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Color seen = bilinear(image, (1 - u - v) * uv[0] + u * uv[1] + v * uv[2]);
      REQUIRE((seen - value(u, v)).cwiseAbs().maxCoeff() < 0.012f);  // three roundings to bytes
    }
  }
}

TEST_CASE("an atlas of nothing is one pixel") {
  const TextureAtlas atlas({});
  CHECK(atlas.paint({}).rgb.size() == 3);
}
