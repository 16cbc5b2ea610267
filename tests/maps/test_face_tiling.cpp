#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "modules/maps/ppm/face_tiling.hpp"
#include "modules/maps/ppm/texel_grid.hpp"

using namespace ppm;

namespace {

using P = std::array<double, 2>;

/// A face with nodes at known places: corners (0, 0), (1, 0), (0, 1).
struct Case {
  FaceNodes nodes;
  std::vector<P> at;
  std::set<std::pair<std::uint32_t, std::uint32_t>> outline;

  Case(std::uint32_t n, std::array<std::uint32_t, 3> sides) {
    const std::array<P, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
    at.assign(corner.begin(), corner.end());
    nodes.divisions = n;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const P &a = corner[k], &b = corner[(k + 1) % 3];
      auto& side = nodes.side[k];
      side.push_back(k);
      for (std::uint32_t s = 1; s < sides[k]; ++s) {
        const double w = static_cast<double>(s) / sides[k];
        side.push_back(static_cast<std::uint32_t>(at.size()));
        at.push_back({(1 - w) * a[0] + w * b[0], (1 - w) * a[1] + w * b[1]});
      }
      side.push_back((k + 1) % 3);
      for (std::size_t s = 0; s + 1 < side.size(); ++s) outline.insert({side[s], side[s + 1]});
    }
    nodes.first_inside = static_cast<std::uint32_t>(at.size());
    for (std::uint32_t i = 1; i + 1 < n; ++i)
      for (std::uint32_t j = 1; i + j < n; ++j) at.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n});
  }
};

double area(const std::vector<P>& at, const std::array<std::uint32_t, 3>& t) {
  const P &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

void check(std::uint32_t n, const std::array<std::uint32_t, 3>& sides) {
  INFO("divisions " << n << ", sides " << sides[0] << " " << sides[1] << " " << sides[2]);
  const Case face(n, sides);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  tile_face(face.nodes, triangles);
  double sum = 0;
  std::set<std::uint32_t> used;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  bool sound = true;
  for (const auto& t : triangles) {
    sound = sound && area(face.at, t) > 1e-9;
    sum += area(face.at, t);
    for (std::size_t k = 0; k < 3; ++k) {
      used.insert(t[k]);
      sound = sound && edges.insert({t[k], t[(k + 1) % 3]}).second;  // no directed edge twice
    }
  }
  CHECK(sound);
  CHECK(sum == Approx(0.5));
  CHECK(used.size() == face.at.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const auto& e : edges)
    if (!edges.contains({e.second, e.first})) open.insert(e);
  CHECK(open == face.outline);
}

}  // namespace

TEST_CASE("a face is filled exactly, however its neighbours divide its sides") {
  for (std::uint32_t n = 1; n <= 5; ++n)
    for (std::uint32_t a = n; a <= n + 4; ++a)
      for (std::uint32_t b = n; b <= n + 4; ++b)
        for (std::uint32_t c = n; c <= n + 4; ++c) check(n, {a, b, c});
  check(1, {255, 1, 1});
  check(2, {2, 255, 64});
  check(7, {255, 7, 8});
  check(64, {64, 64, 64});
}

TEST_CASE("a face whose neighbours divide alike gives its texels' own grid") {
  const Case face(4, {4, 4, 4});
  std::vector<std::array<std::uint32_t, 3>> triangles;
  tile_face(face.nodes, triangles);
  REQUIRE(triangles.size() == 16);
  for (const auto& t : triangles) CHECK(area(face.at, t) == Approx(0.5 / 16));
}
