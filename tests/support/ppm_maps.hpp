#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/digest.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm::test {

inline std::string digest_of(const Map& map) {
  Digest digest;
  map.digest(digest);
  return digest.hex();
}

/// Adds a face with constant texels over vertices of the session.
inline void add_flat_face(PpmEdit& edit, const std::array<std::uint32_t, 3>& ids, std::uint8_t divisions, float mean,
                          float variance, FaceEvidence evidence = {}) {
  const std::vector<float> m(texel_count(divisions), mean), v(texel_count(divisions), variance);
  edit.add_face(ids, divisions, {m, v}, evidence);
}

/// A height field over [0, nx*step] x [0, ny*step], two triangles a square, normals upwards; texels 0 with the prior's
/// variance.
inline std::shared_ptr<const PpmMap> height_field(
    int nx, int ny, float step, const PpmSettings& settings = {},
    const std::function<float(float, float)>& z = [](float, float) { return 0.0f; }) {
  PpmEdit edit(std::make_shared<PpmMap>(settings));
  std::vector<std::uint32_t> id;
  std::vector<Eigen::Vector3f> p;
  for (int y = 0; y <= ny; ++y)
    for (int x = 0; x <= nx; ++x) {
      const float px = static_cast<float>(x) * step, py = static_cast<float>(y) * step;
      p.emplace_back(px, py, z(px, py));
      id.push_back(edit.add_vertex(p.back()));
    }
  const auto variance = static_cast<float>(settings.prior_sigma_m * settings.prior_sigma_m);
  auto face = [&](int a, int b, int c) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b), k = static_cast<std::size_t>(c);
    const auto n = edit.map().divisions_for(p[i], p[j], p[k]);
    add_flat_face(edit, {id[i], id[j], id[k]}, static_cast<std::uint8_t>(n), 0, variance);
  };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      const int a = y * (nx + 1) + x, b = a + 1, c = a + nx + 1, d = c + 1;
      face(a, b, d);
      face(a, d, c);
    }
  return edit.commit();
}

}  // namespace ppm::test
