#include <catch2/catch.hpp>

#include "modules/maps/ppm/remesh.hpp"
#include "tests/refinement/bumps.hpp"
#include "tests/support/described_rays.hpp"

using namespace ppm;
using test::DescribedRays;

namespace {

/// The smallest angle of any face, rad.
double smallest_angle(const PpmMap& map) {
  double least = 4;
  for (const auto& chunk : map.table().chunks())
    for (std::size_t f = 0; f < chunk.geometry->face.size(); ++f) {
      const FaceCorners c = face_corners(*chunk.geometry, f);
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = (c[(k + 1) % 3] - c[k]).cast<double>(), b = (c[(k + 2) % 3] - c[k]).cast<double>();
        least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
      }
    }
  return least;
}

/// Open edges of the whole mesh.
std::size_t boundary_edges(const PpmMap& map) {
  std::vector<std::array<std::uint32_t, 2>> open;
  for (const auto& chunk : map.table().chunks())
    open.insert(open.end(), chunk.geometry->open_edge.begin(), chunk.geometry->open_edge.end());
  std::sort(open.begin(), open.end());
  return static_cast<std::size_t>(std::count_if(open.begin(), open.end(), [&](const auto& e) {
    return !std::binary_search(open.begin(), open.end(), std::array{e[1], e[0]});
  }));
}

struct Totals {
  int hits = 0, through = 0;
};
Totals totals(const PpmMap& map) {
  Totals sum;
  for (const auto& chunk : map.table().chunks())
    for (const auto& e : chunk.texels->evidence) {
      sum.hits += e.hits;
      sum.through += e.through;
    }
  return sum;
}

RemeshSettings settings_of(SplitForm form) {
  RemeshSettings settings;
  settings.form = form;
  settings.bend.bend = form == SplitForm::bisect;
  settings.bend.least = 0.005f;
  return settings;
}

}  // namespace

TEST_CASE("a bend is what moving the corners could not give") {
  constexpr std::uint32_t n = 6;
  std::vector<float> mean, variance(texel_count(n), 1e-6f);
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; i + j <= n; ++j) mean.push_back(0.03f + 0.01f * float(i) - 0.02f * float(j));
  BendSettings settings;
  CHECK_FALSE(largest_bend(n, {mean, variance}, settings));
  settings.bend = false;
  CHECK(largest_bend(n, {mean, variance}, settings));

  settings.bend = true;
  mean[texel_index(n, 2, 2)] += 0.03f;  // one texel alone is an outlier
  CHECK_FALSE(largest_bend(n, {mean, variance}, settings));
  for (auto [i, j] : {std::pair{1u, 2u}, {3u, 2u}, {2u, 1u}, {2u, 3u}, {3u, 1u}, {1u, 3u}})
    mean[texel_index(n, i, j)] += 0.03f;
  const auto bend = largest_bend(n, {mean, variance}, settings);
  REQUIRE(bend);
  CHECK((bend->i == 2 && bend->j == 2));
  CHECK(bend->error == Approx(0.03f));

  settings.sigma_most = 0.0005f;  // texels that know less are not asked
  CHECK_FALSE(largest_bend(n, {mean, variance}, settings));
}

TEST_CASE("faces are divided where the surface bends, conformingly over chunks, and describe what they described") {
  for (const auto form : {SplitForm::bisect, SplitForm::insert}) {
    auto map = test::hill_map(4);
    const auto first = map;
    const auto boundary = boundary_edges(*map);
    const auto settings = settings_of(form);
    std::size_t inserted = 0;
    for (int pass = 0; pass < 6; ++pass) {
      RemeshCounts counts;
      map = remesh(map, settings, &counts);
      map->check();
      inserted += counts.inserted;
    }
    REQUIRE(inserted >= 4);
    CHECK(map->stats().vertices == first->stats().vertices + static_cast<std::int64_t>(inserted));
    CHECK(boundary_edges(*map) == boundary);  // the hill is inside, so no border edge is divided; and no crack opens
    const auto jump = surface_jump(DescribedRays(*first), DescribedRays(*map), {0.6, 0.6, 2}, -Eigen::Vector3d::UnitZ(),
                                   0.25, 400, 1);
    INFO((form == SplitForm::bisect ? "bisect" : "insert")
         << " median " << jump.median << " p99 " << jump.p99 << " most " << jump.most << " lost " << jump.lost);
    CHECK(jump.median < 3e-4);
    CHECK(jump.p99 < 4e-3);
    CHECK(jump.lost < 0.01);
    if (form == SplitForm::bisect) CHECK(smallest_angle(*map) > 0.5 * M_PI / 4 * 0.9);  // Rivara: half of the first
  }
}

TEST_CASE("a bend disappears with enough passes, and then the map is left alone") {
  auto map = test::hill_map(4);
  const auto settings = settings_of(SplitForm::bisect);
  for (int pass = 0; pass < 30; ++pass) {
    const auto next = remesh(map, settings);
    if (next == map) break;
    map = next;
  }
  RemeshCounts counts;
  CHECK(remesh(map, settings, &counts) == map);
  CHECK(counts.bent == 0);
}

TEST_CASE("hits and votes are handed on by area, and none is lost or invented") {
  auto map = test::hill_map(4, {101, 7, 2e-5f});
  const auto before = totals(*map);
  map = remesh(map, settings_of(SplitForm::bisect));
  REQUIRE(map->stats().faces > 32);
  const auto after = totals(*map);
  CHECK(std::abs(after.hits - before.hits) <= static_cast<int>(map->stats().faces) / 2);  // rounding, a half each
  CHECK(std::abs(after.through - before.through) <= static_cast<int>(map->stats().faces) / 2);
  for (const auto& chunk : map->table().chunks())
    for (const auto& e : chunk.texels->evidence) {
      CHECK((e.hits == 101 || std::abs(e.hits - 50) <= 2));
      CHECK(e.excess == Approx(2e-5f));
    }
}

TEST_CASE("dividing a map does not change the map it came from") {
  const auto parent = test::hill_map(4);
  const auto digest = test::digest_of(*parent);
  CHECK(remesh(parent, settings_of(SplitForm::bisect)) != parent);
  CHECK(test::digest_of(*parent) == digest);
}

TEST_CASE("small faces and flat ones are left to their texels") {
  const auto map = test::hill_map(4);
  auto settings = settings_of(SplitForm::bisect);
  settings.edge_least = 0.5f;
  RemeshCounts counts;
  CHECK(remesh(map, settings, &counts) == map);
  CHECK(counts.bent == 0);
  const auto flat = test::describe_height(map, [](float, float) { return 0.03f; });
  CHECK(remesh(flat, settings_of(SplitForm::bisect)) == flat);
}
