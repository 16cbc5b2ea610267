// What a likelihood costs a pixel once its view is sampled: the kernels of weighting.gaussian and weighting.robust
// against the same sums pixel by pixel in double.
#include <algorithm>
#include <benchmark/benchmark.h>

#include "modules/weighting/range_kernels.hpp"
#include "tests/support/range_reference.hpp"

using namespace ppm;

namespace {

constexpr std::size_t kPixels = 176 * 144, kBlock = 1024;
const MixtureTerms kTerms{0.01, 0.1, 0.9, 25e-6};

// Of a whole image, in blocks. score: of one block.
template <class Score>
void image(benchmark::State& state, const Score& score) {
  const test::RangePixels pixels(kPixels);
  for (auto _ : state) {
    ViewScore total;
    for (std::size_t first = 0; first < kPixels; first += kBlock)
      total += score(pixels.arrays(first, std::min(kBlock, kPixels - first)));
    benchmark::DoNotOptimize(total);
  }
  state.counters["pixel"] = benchmark::Counter(static_cast<double>(kPixels * state.iterations()),
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void gaussian(benchmark::State& state) {
  image(state, [](const RangeArrays& a) { return gaussian_score(a, true); });
}
void gaussian_scalar(benchmark::State& state) {
  image(state, [](const RangeArrays& a) { return test::gaussian_reference(a, true); });
}
void mixture(benchmark::State& state) {
  image(state, [](const RangeArrays& a) { return mixture_score(a, kTerms); });
}
void mixture_scalar(benchmark::State& state) {
  image(state, [](const RangeArrays& a) { return test::mixture_reference(a, kTerms); });
}
BENCHMARK(gaussian);
BENCHMARK(gaussian_scalar);
BENCHMARK(mixture);
BENCHMARK(mixture_scalar);

}  // namespace

BENCHMARK_MAIN();
