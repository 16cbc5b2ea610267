#pragma once
#include <cmath>
#include <map>
#include <memory>

#include "modules/maps/ppm/described_face.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "tests/support/ppm_maps.hpp"

namespace ppm::test {

/// Sets the texels so that the map describes the height z = height(x, y): each mean is found along its face's normal.
template <class Height>
std::shared_ptr<const PpmMap> describe_height(std::shared_ptr<const PpmMap> map, Height height, float sigma = 0.002f,
                                              FaceEvidence evidence = {}) {
  PpmEdit edit(std::move(map));
  for (std::uint32_t c = 0; c < edit.map().table().size(); ++c) {
    const Geometry& g = *edit.map().table()[c].geometry;
    Texels& texels = edit.texels(c);
    for (std::size_t f = 0; f < g.face.size(); ++f) {
      const FaceCorners corner = face_corners(g, f);
      const Eigen::Vector3f n = triangle_normal(corner);
      auto t = g.first_texel[f];
      for (std::uint32_t i = 0; i <= g.divisions[f]; ++i)
        for (std::uint32_t j = 0; i + j <= g.divisions[f]; ++j, ++t) {
          const Eigen::Vector3f p = texel_place(corner, g.divisions[f], i, j);
          float m = 0;
          for (int step = 0; step < 20; ++step) {
            const Eigen::Vector3f q = p + m * n;
            m += (height(q.x(), q.y()) - q.z()) * n.z();
          }
          texels.mean[t] = m;
          texels.variance[t] = sigma * sigma;
        }
      texels.evidence[f] = evidence;
    }
  }
  return edit.commit();
}

/// A hill of 6 cm on a square of 1.2 m.
inline float hill(float x, float y) {
  const float r2 = (x - 0.6f) * (x - 0.6f) + (y - 0.6f) * (y - 0.6f);
  return 0.06f * std::exp(-r2 / (2 * 0.2f * 0.2f));
}

/// A flat mesh of 1.2 m over several chunks whose texels describe the hill.
inline std::shared_ptr<const PpmMap> hill_map(int squares = 8, FaceEvidence evidence = {}, float cell = 0.5f) {
  PpmSettings settings;
  settings.cell_size_m = cell;
  return describe_height(height_field(squares, squares, 1.2f / static_cast<float>(squares), settings), hill, 0.002f,
                         evidence);
}

/// The vertices' copies, each once, by id: positions of a map.
inline std::map<std::uint32_t, Eigen::Vector3f> positions(const PpmMap& map) {
  std::map<std::uint32_t, Eigen::Vector3f> at;
  for (const auto& chunk : map.table().chunks())
    for (std::size_t v = 0; v < chunk.geometry->position.size(); ++v)
      at[chunk.geometry->vertex_id[v]] = chunk.geometry->position[v];
  return at;
}

}  // namespace ppm::test
