// The described surface as one mesh: welded, without cracks, where the texels say.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/dense_mesh.hpp"
#include "modules/maps/ppm/welding.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Directed edges without a partner; each directed edge may occur once.
std::set<Edge> open_edges_of(const Mesh& mesh) {
  std::set<Edge> edges, open;
  bool once = true;
  for (const auto& f : mesh.face)
    for (std::size_t k = 0; k < 3; ++k) once = once && edges.insert({f[k], f[(k + 1) % 3]}).second;
  CHECK(once);
  for (const auto& e : edges)
    if (!edges.contains({e.second, e.first})) open.insert(e);
  return open;
}

/// A wavy height field in several chunks whose faces are divided at random, with a hole.
std::shared_ptr<const PpmMap> patchwork(std::uint64_t seed, double sigma_mean) {
  PpmSettings settings;
  settings.cell_size_m = 0.35;
  PpmEdit edit(std::make_shared<PpmMap>(settings));
  Rng rng(seed, 0, 0, 0);
  constexpr std::uint32_t kSide = 8;
  std::vector<std::uint32_t> id;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      const float px = 0.1f * static_cast<float>(x), py = 0.1f * static_cast<float>(y);
      id.push_back(edit.add_vertex({px, py, 0.05f * std::sin(9 * px) * std::cos(7 * py)}));
    }
  auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto n = static_cast<std::uint8_t>(1 + rng.below(7));
    std::vector<float> mean(texel_count(n)), variance(texel_count(n));
    for (auto& m : mean) m = static_cast<float>(sigma_mean * rng.normal());
    for (auto& v : variance) v = static_cast<float>(1e-4 * (0.1 + rng.uniform()));
    edit.add_face({id[a], id[b], id[c]}, n, {mean, variance});
  };
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
      if (x == 3 && y == 4) continue;
      face(a, b, d);
      face(a, d, c);
    }
  return edit.commit();
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.face)
    sum += 0.5 * (mesh.position[b] - mesh.position[a]).cross(mesh.position[c] - mesh.position[a]).norm();
  return sum;
}

}  // namespace

TEST_CASE("the dense mesh has no cracks: its boundary is the image of the base's") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto map = patchwork(seed, 0.004);
    REQUIRE(map->table().size() > 4);
    const Welding welding = weld(*map, WeldEdges::yes);
    const Mesh dense = dense_mesh(*map);
    std::size_t expected = 0;
    for (const auto& edge : welding.edge) expected += edge.faces == 1 ? edge.divisions : 0;
    const auto open = open_edges_of(dense);
    CHECK(open.size() == expected);

    // Walking along the boundary of the dense mesh passes the base's boundary vertices in the base's order.
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [a, b] : open) next[a] = b;
    std::set<Edge> images;
    for (const auto& [from, to] : next) {
      if (from >= welding.position.size()) continue;
      auto at = to;
      while (at >= welding.position.size()) at = next.at(at);
      images.insert({from, at});
    }
    CHECK(images == open_edges_of(base_mesh(*map)));
  }
}

TEST_CASE("without offsets the dense mesh is the base, cut finer") {
  const auto map = patchwork(5, 0);
  const Mesh base = base_mesh(*map), dense = dense_mesh(*map);
  CHECK(area_of(dense) == Approx(area_of(base)));
  for (std::size_t v = 0; v < base.position.size(); ++v) CHECK(dense.position[v] == base.position[v]);
  CHECK(dense.mean.size() == dense.position.size());
  CHECK(dense.variance.size() == dense.position.size());
}

TEST_CASE("one vertex a texel, less those that coincide") {
  const auto map = test::height_field(2, 1, 0.06f);  // 4 faces with divisions n
  const auto n = static_cast<std::size_t>(map->table()[0].geometry->divisions[0]);
  REQUIRE(n >= 2);
  const Mesh dense = dense_mesh(*map);
  CHECK(dense.position.size() == (2 * n + 1) * (n + 1));
  CHECK(dense.face.size() == 4 * n * n);
}

TEST_CASE("where texels coincide the better known one counts more") {
  PpmEdit edit(std::make_shared<PpmMap>(PpmSettings{}));
  const auto a = edit.add_vertex({0, 0, 0}), b = edit.add_vertex({1, 0, 0}), c = edit.add_vertex({1, 1, 0}),
             d = edit.add_vertex({0, 1, 0});
  test::add_flat_face(edit, {a, b, c}, 2, 0.01f, 1e-4f);
  test::add_flat_face(edit, {a, c, d}, 3, 0.04f, 2e-4f);
  const auto map = edit.commit();
  const Mesh dense = dense_mesh(*map);
  int shared = 0;
  for (std::size_t v = 0; v < dense.position.size(); ++v) {
    const auto& p = dense.position[v];
    CHECK(p.z() == dense.mean[v]);
    const bool on_both = std::abs(p.x() - p.y()) < 1e-6f;
    shared += on_both;
    CHECK(dense.mean[v] == Approx(on_both ? 0.02 : p.x() > p.y() ? 0.01 : 0.04));
    CHECK(dense.variance[v] == Approx(on_both ? 2 / (1e4 + 0.5e4) : p.x() > p.y() ? 1e-4 : 2e-4));
  }
  CHECK(shared == 4);  // the finer face's three divisions
  const Mesh base = base_mesh(*map);
  CHECK(base.mean[0] == Approx(0.02));
  CHECK(base.mean[1] == Approx(0.01));
  CHECK(base.position[0].z() == 0);
}

TEST_CASE("around a crease the nodes move to the planes that the texels describe") {
  PpmEdit edit(std::make_shared<PpmMap>(PpmSettings{}));
  // A roof: two planes at 45 degrees to the horizon, ridge along y.
  const auto a = edit.add_vertex({0, 0, 0}), b = edit.add_vertex({0, 1, 0}), l = edit.add_vertex({-1, 0.5f, -1}),
             r = edit.add_vertex({1, 0.5f, -1});
  test::add_flat_face(edit, {a, b, l}, 4, 0.02f, 1e-4f);
  test::add_flat_face(edit, {b, a, r}, 4, 0.02f, 1e-4f);
  const Mesh dense = dense_mesh(*edit.commit());
  for (const auto& p : dense.position) {
    const float left = (p - Eigen::Vector3f::Zero()).dot(Eigen::Vector3f(-1, 0, 1).normalized());
    const float right = p.dot(Eigen::Vector3f(1, 0, 1).normalized());
    CHECK(std::max(left, right) == Approx(0.02).margin(1e-6));
  }
}

TEST_CASE("an empty map gives an empty mesh") {
  const PpmMap map{PpmSettings{}};
  CHECK(dense_mesh(map).position.empty());
  CHECK(base_mesh(map).face.empty());
}
