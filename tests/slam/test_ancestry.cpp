#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "framework/core/rng.hpp"
#include "framework/slam/ancestry.hpp"

namespace {

using namespace ppm;

StampedPose at(int frame) {
  StampedPose p;
  p.frame = frame;
  p.stamp_s = 0.5 * frame;
  return p;
}

/// Paths of particles that share their first pose.
std::vector<Trajectory> begin(std::size_t particles) {
  Trajectory first;
  first.extend(at(0));
  return std::vector<Trajectory>(particles, first);
}

/// One frame: each particle descends from one drawn with equal weights, then takes a step of its own.
void evolve(std::vector<Trajectory>& paths, int frame, Rng& rng) {
  std::vector<Trajectory> next;
  for (std::size_t i = 0; i < paths.size(); ++i) next.push_back(paths[rng.below(static_cast<std::uint32_t>(paths.size()))]);
  paths = std::move(next);
  for (auto& path : paths) path.extend(at(frame));
}

/// The minimal tree the slow way: every pose of every path, with the paths that go on from it and those that end there.
struct Tree {
  std::map<const void*, std::set<const void*>> children;
  std::map<const void*, std::int64_t> ends;
  std::map<const void*, std::int64_t> holders;

  explicit Tree(const std::vector<Trajectory>& paths) {
    for (const auto& path : paths) {
      ++ends[path.identity()];
      for (auto node = path; !node.empty(); node = node.parent()) {
        children[node.identity()];
        holders[node.identity()] = node.holders() - 1;  // without `node`
        if (!node.parent().empty()) children[node.parent().identity()].insert(node.identity());
      }
    }
  }
};

}  // namespace

TEST_CASE("ancestry of a tree made by hand") {
  Trajectory trunk;
  trunk.extend(at(0));
  trunk.extend(at(1));
  auto a = trunk, b = trunk;
  a.extend(at(2));
  b.extend(at(2));
  auto c = a;
  a.extend(at(3));
  b.extend(at(3));
  c.extend(at(3));
  //  0 - 1 - 2 - 3 a
  //       \    \ 3 c
  //        \ 2 - 3 b
  const auto tree = ancestry({a, b, c, a});
  CHECK(tree.nodes == 7);
  CHECK(tree.depth == 4);
  CHECK(tree.branchings == 2);
  CHECK(tree.coalescence_frames == 2);
  CHECK(tree.coalescence_s == Approx(1));

  const auto one = ancestry({b, b});
  CHECK(one.nodes == 4);
  CHECK(one.branchings == 0);
  CHECK(one.coalescence_frames == 0);
  CHECK(ancestry({}).nodes == 0);
  CHECK(ancestry({Trajectory()}).depth == 0);
}

TEST_CASE("paths that share nothing, and paths of different lengths") {
  Trajectory a, b;
  for (int k = 0; k < 3; ++k) a.extend(at(k));
  for (int k = 0; k < 3; ++k) b.extend(at(k));
  const auto apart = ancestry({a, b});
  CHECK(apart.nodes == 6);
  CHECK(apart.branchings == 0);
  CHECK(apart.coalescence_frames == 3);
  CHECK(apart.coalescence_s == Approx(1));

  auto longer = a;
  longer.extend(at(3));
  const auto tree = ancestry({a, longer});
  CHECK(tree.nodes == 4);
  CHECK(tree.coalescence_frames == 1);
}

TEST_CASE("paths keep what their particles descend from, and nothing else") {
  Rng rng(3, 0, 0, 0);
  auto paths = begin(20);
  for (int frame = 1; frame <= 200; ++frame) {
    evolve(paths, frame, rng);
    const Tree tree(paths);
    REQUIRE(ancestry(paths).nodes == tree.children.size());
    // Each pose is held by the poses after it and by the paths that end there: a branch that died would be one more.
    for (const auto& [node, children] : tree.children) {
      const auto ends = tree.ends.contains(node) ? tree.ends.at(node) : 0;
      REQUIRE(tree.holders.at(node) == static_cast<std::int64_t>(children.size()) + ends);
    }
  }
}

TEST_CASE("coalescence and size of the tree are those of the theory") {
  // Equal weights, multinomial resampling: lineages merge as in the Wright-Fisher model, by Kingman's coalescent, so that
  // the common pose lies about 2 N (1 - 1/N) frames back and the tree behind it has about 2 N H(N-1) poses: O(N log N), the
  // bound of Jacob et al., theorem 3.1.
  constexpr std::size_t kParticles = 16;
  constexpr int kRuns = 200, kFrames = 250;
  double back = 0, behind = 0;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    Rng rng(11, 0, run, 0);
    auto paths = begin(kParticles);
    for (int frame = 1; frame <= kFrames; ++frame) evolve(paths, frame, rng);
    const auto tree = ancestry(paths);
    back += static_cast<double>(tree.coalescence_frames) / kRuns;
    behind += static_cast<double>(tree.nodes - (tree.depth - tree.coalescence_frames)) / kRuns;
  }
  double harmonic = 0;
  for (std::size_t k = 1; k < kParticles; ++k) harmonic += 1.0 / static_cast<double>(k);
  CHECK(back == Approx(2 * kParticles * (1 - 1.0 / kParticles)).epsilon(0.15));
  CHECK(behind == Approx(2 * kParticles * harmonic).epsilon(0.2));
}
