#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm::test {

/// Triangles with shared vertices, for building maps.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> position;
  std::vector<std::array<std::uint32_t, 3>> face;  ///< counter-clockwise seen from free space
};

/// The mesh as a map. Texels: mean = mean_of(point), variance = 1 cm^2.
template <class MeanOf>
std::shared_ptr<const PpmMap> make_map(const TriangleMesh& mesh, const PpmSettings& settings, MeanOf&& mean_of) {
  PpmEdit edit(std::make_shared<const PpmMap>(settings));
  std::vector<std::uint32_t> id;
  for (const auto& p : mesh.position) id.push_back(edit.add_vertex(p));
  for (const auto& f : mesh.face) {
    const auto &a = mesh.position[f[0]], &b = mesh.position[f[1]], &c = mesh.position[f[2]];
    const auto n = edit.map().divisions_for(a, b, c);
    std::vector<float> mean(texel_count(n)), variance(texel_count(n), 1e-4f);
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(n),
                    v = static_cast<float>(j) / static_cast<float>(n);
        mean[texel_index(n, i, j)] = mean_of(Eigen::Vector3f((1 - u - v) * a + u * b + v * c));
      }
    edit.add_face({id[f[0]], id[f[1]], id[f[2]]}, static_cast<std::uint8_t>(n), {mean, variance});
  }
  return edit.commit();
}
inline std::shared_ptr<const PpmMap> make_map(const TriangleMesh& mesh, const PpmSettings& settings = {}) {
  return make_map(mesh, settings, [](const Eigen::Vector3f&) { return 0.f; });
}

/// A height field z = height(x, y) over [-half, half]^2 with n x n squares, seen from -z (free space is towards smaller
/// z).
template <class Height>
TriangleMesh height_field(int n, float half, Height&& height) {
  TriangleMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const float px = half * (2.f * static_cast<float>(x) / static_cast<float>(n) - 1.f);
      const float py = half * (2.f * static_cast<float>(y) / static_cast<float>(n) - 1.f);
      mesh.position.emplace_back(px, py, height(px, py));
    }
  auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.face.push_back({at(x, y), at(x, y + 1), at(x + 1, y)});
      mesh.face.push_back({at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)});
    }
  return mesh;
}

/// Triangles of all kinds around the origin: ordinary ones, slivers, huge ones; none shares a vertex with another.
inline TriangleMesh triangle_soup(int n, std::uint64_t seed) {
  Rng rng(seed, 0, 0, purpose_key("soup"));
  TriangleMesh mesh;
  auto point = [&](double r) {
    return Eigen::Vector3f(static_cast<float>(r * rng.normal()), static_cast<float>(r * rng.normal()),
                           static_cast<float>(r * rng.normal()));
  };
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3f a = point(2.0);
    const double kind = rng.uniform();
    const double size = kind < 0.1 ? 8.0 : kind < 0.3 ? 1.0 : 0.2;
    const Eigen::Vector3f e = point(size);
    const bool sliver = kind > 0.85;
    const Eigen::Vector3f f = sliver ? Eigen::Vector3f(0.5f * e + point(0.003)) : point(size);
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    mesh.position.insert(mesh.position.end(), {a, a + e, a + f});
    mesh.face.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace ppm::test
