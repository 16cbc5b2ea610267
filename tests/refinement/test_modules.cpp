#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "modules/maps/ppm/remesh.hpp"
#include "modules/maps/ppm/vertex_adjust.hpp"
#include "tests/refinement/bumps.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

/// The belief's maps after one tick: two particles with one map at different poses, one with another.
std::vector<MapHandle> run(const std::string& module, const std::string& params) {
  Harness h(test::builtin(), module, params);
  auto& belief = h.belief();
  belief.init(3, Pose::Identity(), test::hill_map(4));
  belief.pose[1].translate(Eigen::Vector3d(1, 0, 0));
  belief.map[2] = test::hill_map(6);
  h.tick();
  return belief.map;
}

const PpmMap& ppm_of(const MapHandle& map) {
  return dynamic_cast<const PpmMap&>(*map);
}

}  // namespace

TEST_CASE("refinement.vertex_adjust does what adjust_vertices does, once for each map") {
  const auto maps = run("refinement.vertex_adjust", "{offset_least: 1 cm, step_most: 3 cm, rings: 0}");
  CHECK(maps[0] == maps[1]);  // the edit reads the map alone: other poses do not matter
  AdjustSettings settings;
  settings.least = 0.01f;
  settings.most = 0.03f;
  settings.rings = 0;
  CHECK(test::digest_of(*maps[0]) == test::digest_of(*adjust_vertices(test::hill_map(4), settings)));
  CHECK(test::digest_of(*maps[2]) == test::digest_of(*adjust_vertices(test::hill_map(6), settings)));
}

TEST_CASE("refinement.vertex_adjust has the paper's form") {
  const auto maps =
      run("refinement.vertex_adjust",
          "{offset_sigmas: 0, offset_least: 0, mean: plain, boundary: move, texels: keep, turn_most: 1.4}");
  AdjustSettings settings;
  settings.sigmas = settings.least = 0;
  settings.weighted = settings.reexpress = false;
  settings.boundary = true;
  settings.turn_most = 1.4f;
  CHECK(test::digest_of(*maps[0]) == test::digest_of(*adjust_vertices(test::hill_map(4), settings)));
}

TEST_CASE("refinement.remesh does what remesh does, once for each map") {
  const auto maps = run("refinement.remesh", "{error_least: 5 mm, sigma_most: 5 mm}");
  CHECK(maps[0] == maps[1]);
  RemeshSettings settings;
  settings.bend.least = 0.005f;
  settings.bend.sigma_most = 0.005f;
  CHECK(test::digest_of(*maps[0]) == test::digest_of(*remesh(test::hill_map(4), settings)));
  CHECK(ppm_of(maps[2]).stats().faces > test::hill_map(6)->stats().faces);
}

TEST_CASE("refinement.remesh has the paper's form") {
  const auto maps = run("refinement.remesh", "{error: offset, split: insert, turn_most: 1.4}");
  RemeshSettings settings;
  settings.form = SplitForm::insert;
  settings.bend.bend = false;
  settings.turn_most = 1.4f;
  const auto expected = remesh(test::hill_map(4), settings);
  CHECK(expected->stats().faces > 32);
  CHECK(test::digest_of(*maps[0]) == test::digest_of(*expected));
}

TEST_CASE("refinements refuse parameters that mean nothing") {
  CHECK_THROWS_AS(run("refinement.vertex_adjust", "{step_most: 0}"), ConfigError);
  CHECK_THROWS_AS(run("refinement.vertex_adjust", "{mean: median}"), ConfigError);
  CHECK_THROWS_AS(run("refinement.remesh", "{sigma_most: 0}"), ConfigError);
  CHECK_THROWS_AS(run("refinement.remesh", "{edge_least: 3 deg}"), ConfigError);
}
