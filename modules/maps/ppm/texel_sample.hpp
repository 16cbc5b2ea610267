#pragma once
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// What a chunk's texture says at a point of a face.
struct TexelSample {
  float mean = 0;      ///< m along the face normal
  float variance = 0;  ///< m^2, of the described surface: the texel's, and what its face's excess adds
};

/// The texel nearest to barycentric (u, v) of face f.
inline TexelSample nearest_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  const auto t = geometry.first_texel[f] + nearest_texel(geometry.divisions[f], u, v);
  return {texels.mean[t], texels.variance[t] + texels.evidence[f].added_variance()};
}

/// Mean and variance interpolated linearly over the small triangle of texels around (u, v). The variance is
/// interpolated like the mean: neighbours see the same surface with much the same error, so averaging them does not
/// lower it.
inline TexelSample linear_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v) {
  const TexelTriangle t = texel_triangle(geometry.divisions[f], u, v);
  const float* mean = &texels.mean[geometry.first_texel[f]];
  const float* variance = &texels.variance[geometry.first_texel[f]];
  TexelSample s{0, texels.evidence[f].added_variance()};
  for (int k = 0; k < 3; ++k) {
    s.mean += t.weight[k] * mean[t.texel[k]];
    s.variance += t.weight[k] * variance[t.texel[k]];
  }
  return s;
}

}  // namespace ppm
