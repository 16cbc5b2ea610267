#pragma once
#include <algorithm>
#include <cstdint>

namespace ppm {

/// Texels of a face with n divisions: (n+1)(n+2)/2. Texel (i, j), 0 <= i, j, i+j <= n, lies at u = i/n, v = j/n.
constexpr std::uint32_t texel_count(std::uint32_t n) {
  return (n + 1) * (n + 2) / 2;
}
/// Position of texel (i, j) within the face's texels.
constexpr std::uint32_t texel_index(std::uint32_t n, std::uint32_t i, std::uint32_t j) {
  return i * (n + 1) - i * (i - 1) / 2 + j;
}

/// The three texels around a point of a face, and the point's barycentric weights in their triangle (>= 0, sum 1 to
/// within rounding).
struct TexelTriangle {
  std::uint32_t texel[3];  ///< positions within the face's texels
  float weight[3];
};

/// Around barycentric (u, v). Points outside the face, as rounding gives them, are taken to its border. Inline: it runs
/// for every pixel.
inline TexelTriangle texel_triangle(std::uint32_t n, float u, float v) {
  const auto steps = static_cast<float>(n);
  const float x = std::clamp(u, 0.0f, 1.0f) * steps, y = std::clamp(v, 0.0f, 1.0f) * steps;
  // The grid's square that holds the point; its diagonal cuts it in two, and only the lower half of a row's last one is
  // inside.
  const auto i = std::min(static_cast<std::uint32_t>(x), n - 1);
  const auto j = std::min(static_cast<std::uint32_t>(y), n - 1 - i);
  const float a = std::min(x - static_cast<float>(i), 1.0f), b = std::min(y - static_cast<float>(j), 1.0f);
  const bool upper = a + b > 1.0f && i + j + 2 <= n;
  const float w1 = upper ? 1.0f - b : a, w2 = upper ? 1.0f - a : b;
  return {
      {upper ? texel_index(n, i + 1, j + 1) : texel_index(n, i, j), texel_index(n, i + 1, j), texel_index(n, i, j + 1)},
      {std::max(1.0f - w1 - w2, 0.0f), w1, w2}};
}

/// The texel nearest to barycentric (u, v), by the grid's own measure: the one of largest weight among those around it.
inline std::uint32_t nearest_texel(std::uint32_t n, float u, float v) {
  const TexelTriangle t = texel_triangle(n, u, v);
  const bool second = t.weight[1] > t.weight[0];
  return t.weight[2] > t.weight[second] ? t.texel[2] : t.texel[second];
}

}  // namespace ppm
