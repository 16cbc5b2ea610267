#include <catch2/catch.hpp>
#include <unordered_set>

#include "modules/maps/ppm/ppm_file.hpp"
#include "tests/property/map_experiment.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using test::MapExperiment;

namespace {

std::string digest_of_all(const ParticleSet& belief) {
  Digest digest;
  for (const auto& map : belief.map) map->digest(digest);
  return digest.hex();
}

}  // namespace

TEST_CASE("after any sequence of edits and resamplings every particle's map is its own") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    MapExperiment experiment(seed, false);
    for (int step = 0; step < 150; ++step) {
      experiment.step();
      INFO("seed " << seed << " step " << step);
      for (std::size_t i = 0; i < experiment.belief().size(); ++i)
        REQUIRE(test::naive(experiment.map(i)) == experiment.expected(i));
    }
  }
}

TEST_CASE("whether memory is reused or copied does not show in the result") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MapExperiment reuse(seed, false), copy(seed, true);
    for (int step = 0; step < 100; ++step) {
      reuse.step();
      copy.step();
    }
    CHECK(digest_of_all(reuse.belief()) == digest_of_all(copy.belief()));
  }
}

TEST_CASE("memory that particles share is counted once, and all of it is counted") {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    MapExperiment experiment(seed, false);
    for (int step = 0; step < 120; ++step) experiment.step();
    const auto& belief = experiment.belief();
    std::unordered_set<const void*> seen;
    std::int64_t owned = 0, alone = 0, chunks = 0;
    std::unordered_set<const void*> maps, parts;
    for (std::size_t i = 0; i < belief.size(); ++i) {
      owned += belief.map[i]->account(seen);
      alone += belief.map[i]->stats().bytes;
      maps.insert(belief.map[i].get());
      for (const auto& chunk : experiment.map(i).table().chunks()) {
        if (parts.insert(chunk.geometry.get()).second) chunks += chunk.geometry->bytes();
        if (parts.insert(chunk.texels.get()).second) chunks += chunk.texels->bytes();
      }
    }
    CHECK(owned <= alone);
    CHECK(owned >= chunks);
    CHECK(owned - chunks <
          static_cast<std::int64_t>(maps.size() * (sizeof(PpmMap) + experiment.map(0).table().size() * 256 + 8192)));
    for (const auto& map : belief.map) CHECK(map->account(seen) == 0);
  }
}

TEST_CASE("any map that edits can make is saved and loaded exactly") {
  test::TempFolder dir;
  for (std::uint64_t seed = 30; seed < 34; ++seed) {
    MapExperiment experiment(seed, false);
    for (int step = 0; step < 100; ++step) experiment.step();
    for (std::size_t i = 0; i < experiment.belief().size(); ++i) {
      save_ppm(experiment.map(i), dir / "map.ppm");
      const auto back = load_ppm(dir / "map.ppm");
      CHECK(test::digest_of(*back) == test::digest_of(experiment.map(i)));
      CHECK(test::naive(*back) == experiment.expected(i));
    }
  }
}
