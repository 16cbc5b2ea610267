#include <catch2/catch.hpp>

#include "tests/property/map_life.hpp"
#include "tests/support/described_rays.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;
using test::MapLife;

namespace {

std::vector<std::string> digests(const ParticleSet& belief) {
  std::vector<std::string> all;
  for (const auto& map : belief.map) all.push_back(test::digest_of(*map));
  return all;
}

}  // namespace

TEST_CASE("through updates, adjustments, remeshing and resampling every map stays sound and its own") {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    MapLife life(seed);
    for (int step = 0; step < 40; ++step) {
      const auto before = digests(life.belief());
      const auto event = life.step();
      INFO("seed " << seed << " step " << step << " event " << static_cast<int>(event));
      if (event == MapLife::Event::gather) continue;
      REQUIRE_NOTHROW(life.map(life.particle())->check());
      for (std::size_t i = 0; i < before.size(); ++i)
        if (i != life.particle()) REQUIRE(test::digest_of(*life.map(i)) == before[i]);
    }
    CHECK(life.changed > 20);
  }
}

TEST_CASE("adjusting and remeshing leave the described surface of a map that was seen where it is") {
  for (std::uint32_t seed = 11; seed <= 13; ++seed) {
    MapLife life(seed);
    for (int step = 0; step < 40; ++step) {
      const std::vector<std::shared_ptr<const PpmMap>> before{life.map(0), life.map(1), life.map(2)};
      const auto event = life.step();
      const auto &old = before[life.particle()], now = life.map(life.particle());
      if (event == MapLife::Event::update || event == MapLife::Event::gather || now == old) continue;
      const auto jump = surface_jump(test::DescribedRays(*old), test::DescribedRays(*now), {0, 0, -0.3},
                                     Eigen::Vector3d::UnitZ(), 0.5, 400, seed);
      INFO("seed " << seed << " step " << step << " event " << static_cast<int>(event) << ": median " << jump.median
                   << ", 95 % " << jump.p95 << ", 99 % " << jump.p99 << ", most " << jump.most << " m, lost "
                   << jump.lost);
      CHECK(jump.median < 1e-4);
      CHECK(jump.p95 < 5e-4);
      CHECK(jump.p99 < 4e-3);
      CHECK(jump.most < 2e-2);  // at folds, where displaced faces part or cross
      CHECK(jump.lost < 0.01);
    }
  }
}
