// What is done to maps and beliefs beside views: resampling, simplification.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <numeric>

#include "apps/bench/bench_case.hpp"
#include "framework/core/rng.hpp"
#include "framework/core/timing.hpp"
#include "framework/graph/harness.hpp"

namespace ppm {
namespace {

constexpr int kPathLength = 300;
constexpr int kSimplified = 5000;  // triangles: large ones, whose texels are many

/// Systematic draws of a belief with uneven weights: about half of the particles live on.
std::vector<std::uint32_t> ancestors_of(std::size_t n) {
  Rng rng(3, 0, 0, purpose_key("ancestors"));
  std::vector<std::uint32_t> ancestors(n);
  for (auto& a : ancestors) a = rng.below(static_cast<std::uint32_t>(n));
  std::ranges::sort(ancestors);
  return ancestors;
}

void gather(const BenchPlan& plan, std::size_t particles, benchmark::State& state) {
  ParticleSet belief;
  belief.init(particles, Pose::Identity(), plan.worlds.of(plan.triangles.front(), plan.cols).map);
  for (std::size_t i = 0; i < particles; ++i)
    for (int k = 0; k < kPathLength; ++k) belief.extend(i, {k, 0.1 * k, Pose::Identity()});
  const auto ancestors = ancestors_of(particles);
  for (auto _ : state) {
    const Stopwatch watch;
    belief.gather(ancestors);
    state.SetIterationTime(watch.seconds());
  }
  state.counters["items"] = static_cast<double>(particles);
}

void simplify(const BenchPlan& plan, const std::string& module, benchmark::State& state) {
  const auto map = plan.worlds.of(kSimplified, plan.cols).map;
  Harness h(plan.registry, module, "{hits_least: 0}");
  std::int64_t left = 0;
  for (auto _ : state) {
    h.belief().init(1, Pose::Identity(), map);
    const Stopwatch watch;
    h.tick();
    state.SetIterationTime(watch.seconds());
    left = h.belief().map[0]->stats().faces;
  }
  const auto before = static_cast<double>(map->stats().faces);
  state.counters["items"] = 1e-3 * before;
  state.counters["faces_left"] = static_cast<double>(left) / before;
}

}  // namespace

void add_map_cases(const BenchPlan& plan, std::vector<BenchCase>& cases) {
  for (int particles : plan.quick ? std::vector<int>{10} : std::vector<int>{100, 1000})
    cases.push_back({"gather", {{"particles", std::to_string(particles)}}, "particle", [&plan, particles](auto& state) {
                       gather(plan, static_cast<std::size_t>(particles), state);
                     }});
  for (const ModuleInfo* info : plan.registry.all()) {
    if (!info->name.starts_with("simplify.")) continue;
    cases.push_back({"simplify",
                     {{"module", info->name}, {"triangles", std::to_string(kSimplified)}},
                     "1000 triangles",
                     [&plan, module = info->name](auto& state) { simplify(plan, module, state); }});
  }
}

}  // namespace ppm
