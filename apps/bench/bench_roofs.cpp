// What the machine can do at best: floating-point operations, and bytes read from memory.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <memory>

#include "apps/bench/bench_case.hpp"
#include "apps/bench/roofs.hpp"
#include "framework/core/timing.hpp"

namespace ppm {
namespace {

constexpr std::size_t kRounds = 1'000'000;  // of one part
constexpr std::size_t kParts = 4;           // a thread: one that starts late does fewer

void flops(int threads, benchmark::State& state) {
  const Workers workers(threads);
  const std::size_t n = kParts * static_cast<std::size_t>(threads);
  std::vector<FlopsDone> done(n);
  for (auto _ : state) {
    const Stopwatch watch;
    workers.for_each(n, [&](std::size_t i, int) { done[i] = multiply_adds(kRounds); });
    state.SetIterationTime(watch.seconds());
    benchmark::DoNotOptimize(done.data());
  }
  state.counters["items"] = 1e-9 * done.front().flops * static_cast<double>(n);
}

struct Aligned {
  void operator()(float* p) const { ::operator delete[](p, std::align_val_t{64}); }
};

/// Reads an array that no cache holds, cut into as many parts as there are threads.
void read(int threads, std::size_t bytes, benchmark::State& state) {
  const Workers workers(threads);
  const std::size_t parts = kParts * static_cast<std::size_t>(threads),
                    part = bytes / sizeof(float) / parts / 256 * 256;
  const std::unique_ptr<float[], Aligned> data(new (std::align_val_t{64}) float[part * parts]);
  workers.for_each(parts, [&](std::size_t i, int) { std::fill_n(&data[i * part], part, 1.f); });
  std::vector<float> sums(parts);
  for (auto _ : state) {
    const Stopwatch watch;
    workers.for_each(parts, [&](std::size_t i, int) { sums[i] = read_sum(&data[i * part], part); });
    state.SetIterationTime(watch.seconds());
    benchmark::DoNotOptimize(sums.data());
  }
  state.counters["items"] = 1e-9 * static_cast<double>(parts * part * sizeof(float));
}

}  // namespace

void add_roof_cases(const BenchPlan& plan, std::vector<BenchCase>& cases) {
  const std::size_t bytes = plan.quick ? 16'000'000 : 512'000'000;
  for (int threads : plan.threads) {
    const auto n = std::to_string(threads);
    cases.push_back(
        {"roof", {{"of", "flops"}, {"threads", n}}, "GFLOP", [threads](auto& state) { flops(threads, state); }});
    cases.push_back({"roof", {{"of", "read"}, {"threads", n}}, "GB", [threads, bytes](auto& state) {
                       read(threads, bytes, state);
                     }});
  }
}

}  // namespace ppm
