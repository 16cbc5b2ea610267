#include "modules/maps/ppm/texel_sample.hpp"

#include <algorithm>

namespace ppm {

TexelSample nearest_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  auto t = geometry.first_texel[f] + nearest_texel(geometry.divisions[f], u, v);
  return {texels.mean[t], texels.variance[t]};
}

TexelSample linear_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  const std::uint32_t n = geometry.divisions[f];
  const float scale = static_cast<float>(n);
  // (i, j): the square of the grid that holds the point, kept inside the face when rounding puts the point outside.
  const float x = std::clamp(u, 0.f, 1.f) * scale, y = std::clamp(v, 0.f, 1.f) * scale;
  const auto i = std::min(static_cast<std::uint32_t>(x), n - 1);
  const auto j = std::min(static_cast<std::uint32_t>(y), n - 1 - i);
  const float a = std::clamp(x - static_cast<float>(i), 0.f, 1.f), b = std::clamp(y - static_cast<float>(j), 0.f, 1.f);
  // The square's diagonal cuts it in two; its upper half is outside the face in the last square of a row.
  const bool upper = a + b > 1.f && i + j + 2 <= n;
  const std::uint32_t base = geometry.first_texel[f];
  const std::uint32_t t1 = base + texel_index(n, i + 1, j), t2 = base + texel_index(n, i, j + 1);
  const std::uint32_t t0 = base + (upper ? texel_index(n, i + 1, j + 1) : texel_index(n, i, j));
  float w1 = upper ? 1.f - b : a, w2 = upper ? 1.f - a : b;
  const float over = std::max(w1 + w2, 1.f);
  w1 /= over;
  w2 /= over;
  const float w0 = 1.f - w1 - w2;
  return {w0 * texels.mean[t0] + w1 * texels.mean[t1] + w2 * texels.mean[t2],
          w0 * texels.variance[t0] + w1 * texels.variance[t1] + w2 * texels.variance[t2]};
}

}  // namespace ppm
