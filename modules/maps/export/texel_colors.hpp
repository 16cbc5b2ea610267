#pragma once
#include <optional>
#include <vector>

#include "modules/maps/picture/color_scale.hpp"
#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

/// [T] what is to be shown at each texel of a chunk: not Show::shaded. scale: for sigma and mean.
std::vector<Color> texel_colors(const PpmChunk& chunk, Show show, const std::optional<ColorScale>& scale);

}  // namespace ppm
