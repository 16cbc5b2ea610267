#include <catch2/catch.hpp>
#include <unordered_set>

#include "framework/graph/harness.hpp"
#include "framework/slam/map_memory.hpp"
#include "tests/refinement/bumps.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

TEST_CASE("refinement.deep_copy leaves every particle the same map in memory of its own") {
  Harness h(test::builtin(), "refinement.deep_copy", "{}", 2);
  const auto map = test::hill_map();
  h.belief().init(3, Pose::Identity(), map);
  const auto shared = map_memory(h.belief());
  REQUIRE(shared.alone > 2 * shared.together);
  h.tick();
  const auto copied = map_memory(h.belief());
  CHECK(copied.together > 2.9 * static_cast<double>(shared.together));
  for (const auto& copy : h.belief().map) {
    Digest a, b;
    map->digest(a);
    copy->digest(b);
    CHECK(a.hex() == b.hex());
  }
  std::unordered_set<const void*> seen;
  for (const auto& copy : h.belief().map)
    for (const auto& chunk : dynamic_cast<const PpmMap&>(*copy).table().chunks()) {
      CHECK(seen.insert(chunk.texels.get()).second);
      CHECK(seen.insert(chunk.geometry.get()).second);
    }
}

TEST_CASE("refinement.constant_variance makes all texels equally certain and moves none") {
  Harness h(test::builtin(), "refinement.constant_variance", "{sigma: 4 mm}");
  const auto map = test::hill_map();
  h.belief().init(2, Pose::Identity(), map);
  h.tick();
  const auto edited = std::static_pointer_cast<const PpmMap>(h.belief().map[0]);
  CHECK(edited == h.belief().map[1]);
  REQUIRE(edited->table().size() == map->table().size());
  for (std::size_t c = 0; c < map->table().size(); ++c) {
    const Texels &before = *map->table()[c].texels, &after = *edited->table()[c].texels;
    CHECK(after.mean == before.mean);
    for (float v : after.variance) CHECK(v == Approx(16e-6));
    for (const auto& e : after.evidence) CHECK(e.excess == 0);
  }
  const auto first = edited->table()[0].texels.get();
  h.tick();
  CHECK(std::static_pointer_cast<const PpmMap>(h.belief().map[0])->table()[0].texels.get() == first);
}
