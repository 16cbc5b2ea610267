#pragma once
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// What a chunk's texture says at a point of a face.
struct TexelSample {
  float mean = 0;      ///< m along the face normal
  float variance = 0;  ///< m^2
};

/// The texel nearest to barycentric (u, v) of face f.
TexelSample nearest_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v);

/// Mean and variance interpolated linearly over the small triangle of texels around (u, v). The variance is interpolated like
/// the mean: neighbours see the same surface with much the same error, so averaging them does not lower it.
TexelSample linear_sample(const Geometry& geometry, const Texels& texels, std::uint32_t f, float u, float v);

}  // namespace ppm
