#include <catch2/catch.hpp>

#include "modules/maps/ppm/vertex_adjust.hpp"
#include "tests/refinement/bumps.hpp"
#include "tests/support/described_rays.hpp"

using namespace ppm;
using test::DescribedRays;
using test::hill;

namespace {

/// The described surface before and after, seen from above.
test::SurfaceJump jump_of(const PpmMap& before, const PpmMap& after) {
  return surface_jump(DescribedRays(before), DescribedRays(after), {0.6, 0.6, 2}, -Eigen::Vector3d::UnitZ(), 0.25, 400,
                      1);
}
bool on_border(const Eigen::Vector3f& p) {
  return p.x() < 0.01f || p.y() < 0.01f || p.x() > 1.19f || p.y() > 1.19f;
}

}  // namespace

TEST_CASE("vertices move onto the described surface, and the described surface stays where it was") {
  const auto before = test::hill_map();
  AdjustSettings settings;
  settings.rings = 0;
  AdjustCounts counts;
  const auto after = adjust_vertices(before, settings, &counts);
  after->check();
  REQUIRE(counts.moved > 10);
  CHECK(counts.farthest == Approx(settings.most));
  const auto at = test::positions(*after);
  for (const auto& [id, p] : test::positions(*before)) {
    const float offset = hill(p.x(), p.y());
    if (offset <= settings.least)
      CHECK(at.at(id) == p);
    else
      CHECK(std::abs(at.at(id).z() - std::min(offset, settings.most)) < 1e-4f);
  }
  const auto jump = jump_of(*before, *after);
  CHECK(jump.median < 1e-4);
  CHECK(jump.p99 < 1e-3);
  CHECK(jump.most < 2e-3);  // of the 5 cm that vertices moved: texels beside a fold read where it was
  CHECK(jump.lost < 0.01);
}

TEST_CASE("an adjusted mesh is left alone, and the handle with it") {
  auto map = test::hill_map();
  AdjustSettings settings;
  settings.rings = 0;
  for (int pass = 0; pass < 3; ++pass) map = adjust_vertices(map, settings);
  AdjustCounts counts;
  const auto again = adjust_vertices(map, settings, &counts);
  CHECK(again == map);
  CHECK(counts.moved == 0);
}

TEST_CASE("a map where nothing passes the thresholds keeps its chunks") {
  const auto map = test::hill_map();
  AdjustSettings far;
  far.least = 0.1f;
  CHECK(adjust_vertices(map, far) == map);
  AdjustSettings sure;
  sure.sigmas = 100;  // of 2 mm
  CHECK(adjust_vertices(map, sure) == map);
  const auto empty = std::make_shared<const PpmMap>(PpmSettings{});
  CHECK(adjust_vertices(empty, {}) == empty);
}

TEST_CASE("adjusting a map does not change the map it came from") {
  const auto parent = test::hill_map();
  const auto digest = test::digest_of(*parent);
  const auto child = adjust_vertices(parent, {});
  CHECK(child != parent);
  CHECK(test::digest_of(*child) != digest);
  CHECK(test::digest_of(*parent) == digest);
}

TEST_CASE("vertices on the boundary stay unless they are to move") {
  const auto raised = [](float, float) { return 0.02f; };
  const auto map = test::describe_height(test::hill_map(), raised);
  const auto kept = test::positions(*adjust_vertices(map, {}));
  AdjustSettings settings;
  settings.boundary = true;
  const auto moved = test::positions(*adjust_vertices(map, settings));
  int border = 0;
  for (const auto& [id, p] : test::positions(*map)) {
    CHECK(moved.at(id).z() == Approx(0.02f));
    CHECK(kept.at(id).z() == Approx(on_border(p) ? 0.0f : 0.02f));
    border += on_border(p);
  }
  CHECK(border == 32);
}

TEST_CASE("no face turns further than allowed: its vertices stay") {
  // One vertex of a fine mesh says that it lies 10 cm higher: its faces would stand on edge.
  const auto spike = [](float x, float y) { return std::hypot(x - 0.6f, y - 0.6f) < 0.02f ? 0.1f : 0.0f; };
  const auto map = test::describe_height(test::hill_map(24), spike);
  AdjustSettings settings;
  settings.rings = 0;
  settings.most = 1;
  AdjustCounts counts;
  CHECK(adjust_vertices(map, settings, &counts) == map);
  CHECK(counts.refused >= 1);
  settings.turn_most = 1.4f;
  const auto turned = adjust_vertices(map, settings, &counts);
  CHECK(counts.moved == 1);
  turned->check();
}

TEST_CASE("the plain mean counts all texels alike, the weighted one those that know") {
  auto map = test::describe_height(test::hill_map(), [](float, float) { return 0.02f; });
  PpmEdit edit(map);
  for (std::uint32_t c = 0; c < map->table().size(); ++c) {  // every second face was never observed
    const Geometry& g = *map->table()[c].geometry;
    Texels& texels = edit.texels(c);
    for (std::size_t f = 0; f < g.face.size(); f += 2)
      for (std::uint32_t t = 0; t < texel_count(g.divisions[f]); ++t) {
        texels.mean[g.first_texel[f] + t] = 0;
        texels.variance[g.first_texel[f] + t] = 0.05f * 0.05f;
      }
  }
  map = edit.commit();
  AdjustSettings settings;
  settings.sigmas = 0;
  settings.least = 0;
  settings.boundary = true;
  double weighted = 0, plain = 0;
  for (const auto& [id, p] : test::positions(*adjust_vertices(map, settings))) weighted += p.z() / 81;
  settings.weighted = false;
  for (const auto& [id, p] : test::positions(*adjust_vertices(map, settings))) plain += p.z() / 81;
  CHECK(weighted > 0.017);
  CHECK(plain == Approx(0.01).margin(0.002));
}

TEST_CASE("means that are kept move the described surface with the vertices") {
  const auto map = test::describe_height(test::hill_map(), [](float, float) { return 0.02f; });
  AdjustSettings settings;
  settings.reexpress = false;
  settings.boundary = true;
  const auto jump = jump_of(*map, *adjust_vertices(map, settings));
  CHECK(jump.median == Approx(0.02).epsilon(0.05));
}
