#pragma once
#include "framework/slam/color.hpp"
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// What a chunk's texture says of the colour at a point of a face, in a map with colour.
struct ColorSample {
  ColorValue mean{};
  float variance = 0;  ///< of each channel
};

/// The texel nearest to barycentric (u, v) of face f.
inline ColorSample nearest_color(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  const std::size_t t = geometry.first_texel[f] + nearest_texel(geometry.divisions[f], u, v), n = texels.channels();
  ColorSample s{{}, texels.color_variance[t]};
  for (std::size_t c = 0; c < n; ++c) s.mean[c] = texels.color[n * t + c];
  return s;
}

/// Interpolated over the small triangle of texels around (u, v), each weighted by its certainty too, so that texels
/// which were never seen do not grey their neighbours. The variance is theirs and how much they differ: a pattern finer
/// than texels, and small errors of pose or registration, put a neighbour's colour in a point's place.
inline ColorSample linear_color(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  const TexelTriangle triangle = texel_triangle(geometry.divisions[f], u, v);
  const std::size_t n = texels.channels();
  float weight[3], total = 0;
  const float* color[3];
  for (int k = 0; k < 3; ++k) {
    const std::size_t t = geometry.first_texel[f] + triangle.texel[k];
    color[k] = &texels.color[n * t];
    weight[k] = (triangle.weight[k] + 1e-6f) / texels.color_variance[t];
    total += weight[k];
  }
  ColorSample s;
  float square = 0;
  for (int k = 0; k < 3; ++k) {
    weight[k] /= total;
    s.variance += weight[k] * texels.color_variance[geometry.first_texel[f] + triangle.texel[k]];
    for (std::size_t c = 0; c < n; ++c) {
      s.mean[c] += weight[k] * color[k][c];
      square += weight[k] * color[k][c] * color[k][c];
    }
  }
  for (std::size_t c = 0; c < n; ++c) square -= s.mean[c] * s.mean[c];
  s.variance += std::max(square, 0.0f) / static_cast<float>(n);
  return s;
}

}  // namespace ppm
