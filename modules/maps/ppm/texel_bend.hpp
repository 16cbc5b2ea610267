#pragma once
#include <cstdint>
#include <optional>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// When the texels of a face say that the face itself should bend.
struct BendSettings {
  /// What a texel's mean is compared with: the plane through the face's corners, each at its own offset, after
  /// averaging over the neighbours (true); the face itself, texel by texel (false: the paper's form).
  bool bend = true;
  float sigmas = 3;          ///< the error must be more than so many of the texel's standard deviations ...
  float least = 0.02f;       ///< ... and more than this, m
  float sigma_most = 0.01f;  ///< m; texels that are less certain than this are not asked
};

/// The texel that errs most.
struct TexelBend {
  std::uint32_t i = 0, j = 0;
  float error = 0;   ///< m, signed, along the face's normal
  float offset = 0;  ///< m, the texel's mean
};

/// The texel inside the face, or on its sides where settings.bend is set, with the largest error that passes the
/// thresholds; nothing where none does. A face with one division has none.
std::optional<TexelBend> largest_bend(std::uint32_t divisions, const TexelView& texels, const BendSettings& settings);

}  // namespace ppm
