#include "modules/maps/export/texel_colors.hpp"

#include <cmath>

#include "modules/maps/ppm/face_texels.hpp"

namespace ppm {

std::vector<Color> texel_colors(const PpmChunk& chunk, Show show, const std::optional<ColorScale>& scale) {
  const Geometry& geometry = *chunk.geometry;
  const Texels& texels = *chunk.texels;
  std::vector<Color> colors(texels.size());
  const TexelView all = texels.view(0, texels.size());
  for (std::size_t f = 0; f < geometry.face.size(); ++f) {
    const Color normal = normal_color(geometry.face_normal(f));
    const float added = texels.evidence[f].added_variance();
    const std::uint32_t first = geometry.first_texel[f];
    for (std::uint32_t t = first; t < first + texel_count(geometry.divisions[f]); ++t) {
      if (show == Show::normal) colors[t] = normal;
      if (show == Show::mean) colors[t] = scale->color(texels.mean[t]);
      if (show == Show::sigma) colors[t] = scale->color(std::sqrt(texels.variance[t] + added));
      if (show == Show::color) colors[t] = texel_color(all, t);
    }
  }
  return colors;
}

}  // namespace ppm
