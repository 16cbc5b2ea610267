#pragma once
#include <memory>
#include <vector>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "modules/maps/ppm/triangle_mesh.hpp"

namespace ppm::test {

using ppm::TriangleMesh;

/// The mesh as a map. Texels: mean = mean_of(point), variance = 1 cm^2.
template <class MeanOf>
std::shared_ptr<const PpmMap> make_map(const TriangleMesh& mesh, const PpmSettings& settings, MeanOf&& mean_of) {
  return map_of(mesh, settings, mean_of, 1e-4f);
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
