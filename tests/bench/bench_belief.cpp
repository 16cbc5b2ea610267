// What a particle costs: resampling, the first edit after it, and a step of its path. One map of 2,000 chunks (64,000
// faces), as after a large room or a small flat.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <random>

#include "framework/slam/particle_set.hpp"
#include "tests/support/ppm_maps.hpp"

namespace {

using namespace ppm;

/// 50 m x 40 m in cells of 1 m: 2,000 chunks of 32 faces.
std::shared_ptr<const PpmMap> large_map() {
  PpmSettings settings;
  settings.texel_size_m = 0.05;
  static const auto map = test::height_field(200, 160, 0.25f, settings);
  return map;
}

/// A map of its own that shares all chunks but one.
std::shared_ptr<const PpmMap> edited(const std::shared_ptr<const PpmMap>& map, std::uint32_t chunk) {
  PpmEdit edit(map);
  edit.texels(chunk).mean[0] += 0.001f;
  return edit.commit();
}

/// Each particle with its own map and a path of 300 poses.
ParticleSet belief_of(std::size_t particles) {
  ParticleSet belief;
  belief.init(particles, Pose::Identity(), large_map());
  for (std::size_t i = 0; i < particles; ++i) {
    belief.map[i] = edited(large_map(), static_cast<std::uint32_t>(i) % 2000);
    for (int k = 0; k < 300; ++k) belief.extend(i, {k, 0.1 * k, Pose::Identity()});
  }
  return belief;
}

/// Resampling of 1,000 particles: every column moves, no map is copied.
void gather(benchmark::State& state) {
  auto belief = belief_of(static_cast<std::size_t>(state.range(0)));
  std::mt19937 random(1);
  std::vector<std::uint32_t> ancestors(belief.size());
  for (auto _ : state) {
    state.PauseTiming();
    for (auto& a : ancestors) a = static_cast<std::uint32_t>(random() % belief.size());
    std::sort(ancestors.begin(), ancestors.end());
    state.ResumeTiming();
    belief.gather(ancestors);
  }
  state.counters["chunks"] = static_cast<double>(large_map()->table().size());
}
BENCHMARK(gather)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

/// The first edit of a copy: the table's pointers are copied, then as many chunks are cloned as are written.
void first_edit_of_a_copy(benchmark::State& state) {
  const auto map = large_map();
  for (auto _ : state) {
    PpmEdit edit(map);
    for (std::uint32_t chunk = 0; chunk < state.range(0); ++chunk) edit.texels(chunk).mean[0] = 1;
    benchmark::DoNotOptimize(edit.commit());
  }
}
BENCHMARK(first_edit_of_a_copy)->Arg(0)->Arg(1)->Arg(20)->Arg(2000)->Unit(benchmark::kMicrosecond);

/// Later edits of the same particle: nothing is copied any more.
void later_edit(benchmark::State& state) {
  auto map = edited(large_map(), 0);
  for (auto _ : state) {
    PpmEdit edit(std::move(map));
    edit.texels(0).mean[0] += 1;
    map = edit.commit();
  }
}
BENCHMARK(later_edit)->Unit(benchmark::kMicrosecond);

/// One more pose for each of 1,000 particles.
void extend(benchmark::State& state) {
  ParticleSet belief;
  belief.init(1000, Pose::Identity(), nullptr);
  for (auto _ : state) {
    for (std::size_t i = 0; i < belief.size(); ++i) belief.extend(i, {0, 0, Pose::Identity()});
    if (belief.trajectory[0].length() < 1000) continue;
    state.PauseTiming();
    belief.init(1000, Pose::Identity(), nullptr);
    state.ResumeTiming();
  }
}
BENCHMARK(extend)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
