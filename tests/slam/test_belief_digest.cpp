#include <catch2/catch.hpp>
#include <set>

#include "framework/slam/belief_digest.hpp"
#include "framework/slam/map_memory.hpp"

namespace {

using namespace ppm;

/// A map that is a number; a block of 100 bytes, which maps of one number share.
struct NumberMap final : Map {
  NumberMap(int n, const void* b) : number(n), block(b) {}
  std::string_view kind() const override { return "number"; }
  MapStats stats() const override { return {0, 0, 0, 0, 100}; }
  std::int64_t account(std::unordered_set<const void*>& seen) const override {
    return seen.insert(block).second ? 100 : 0;
  }
  void digest(Digest& d) const override { d.add(number); }
  Mesh mesh(Surface) const override { return {}; }
  int number;
  const void* block;
};

const int kBlockA = 0, kBlockB = 0;

ParticleSet belief(bool shared = true) {
  ParticleSet set;
  set.init(4, Pose::Identity(), std::make_shared<NumberMap>(7, &kBlockA));
  for (std::size_t i = 0; i < 4; ++i) set.extend(i, {3, 0.3, Pose::Identity()});
  if (!shared) set.map[1] = std::make_shared<NumberMap>(7, &kBlockA);  // equal, and another object
  return set;
}

std::string hex(const ParticleSet& set, int threads = 1) {
  return belief_digest(set, Workers(threads));
}

}  // namespace

TEST_CASE("the digest is of contents: not of addresses, not of threads") {
  CHECK(hex(belief()) == hex(belief()));
  CHECK(hex(belief()) == hex(belief(false)));
  CHECK(hex(belief(), 4) == hex(belief()));
  CHECK(hex(belief()).size() == 32);
}

TEST_CASE("everything that a belief is changes its digest") {
  std::set<std::string> digests{hex(belief())};
  auto changed = [&](auto change) {
    auto set = belief();
    change(set);
    digests.insert(hex(set));
  };
  changed([](auto& s) { s.correct(2, Pose(Eigen::Translation3d(1e-15, 0, 0))); });
  changed([](auto& s) { s.log_weight[0] += 1e-15; });
  changed([](auto& s) { s.extend(1, {4, 0.4, Pose::Identity()}); });
  changed([](auto& s) { s.map[3] = std::make_shared<NumberMap>(8, &kBlockA); });
  changed([](auto& s) { s.map[2] = std::make_shared<NumberMap>(8, &kBlockA); });
  changed([](auto& s) { s.gather({0, 1, 2}); });
  CHECK(digests.size() == 7);
}

TEST_CASE("a belief without particles, or without maps, has a digest too") {
  CHECK(hex(ParticleSet{}).size() == 32);
  ParticleSet set;
  set.init(2, Pose::Identity(), nullptr);
  CHECK(hex(set) != hex(ParticleSet{}));
  CHECK(map_memory(set).alone == 0);
}

TEST_CASE("memory: shared blocks count once together, and for each alone") {
  auto set = belief();
  CHECK(map_memory(set).together == 100);
  CHECK(map_memory(set).alone == 400);
  set.map[1] = std::make_shared<NumberMap>(7, &kBlockB);
  CHECK(map_memory(set).together == 200);
  CHECK(map_memory(set).alone == 400);
}
