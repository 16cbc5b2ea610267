#include "apps/bench/bench_run.hpp"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdlib>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"

namespace ppm {
namespace {

/// Collects what Google Benchmark measures. A benchmark's name is the number of its case.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  Collector(const std::vector<BenchCase>& cases, Log& log) : cases_(cases), log_(log), samples_(cases.size()) {}

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto number = static_cast<std::size_t>(std::atoi(run.benchmark_name().c_str()));
      take(run, samples_[number]);
      log_.status(fmt::format("round {} of {}, {}", round, rounds, cases_[number].name()));
    }
  }

  std::vector<BenchResult> results() const {
    std::vector<BenchResult> all;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Samples& s = samples_[i];
      BenchResult r{&cases_[i], quantile(s.ms, 0.5), quantile(s.ms, 0), s.cpu_ms.empty() ? 0 : quantile(s.cpu_ms, 0.5),
                    s.counters, s.left_out};
      all.push_back(std::move(r));
    }
    return all;
  }

  int round = 1, rounds = 1;

 private:
  struct Samples {
    std::vector<double> ms, cpu_ms;
    std::map<std::string, double> counters;
    std::string left_out;
  };

  static void take(const Run& run, Samples& samples) {
    if (run.error_occurred) {
      samples.left_out = run.error_message;
      return;
    }
    const auto iterations = static_cast<double>(run.iterations);
    const double items = iterations * run.counters.at("items").value;
    samples.ms.push_back(1e3 * run.real_accumulated_time / items);
    samples.counters.clear();
    for (const auto& [name, counter] : run.counters) {
      if (name == "cpu_s")
        samples.cpu_ms.push_back(1e3 * counter.value / items);
      else if (name != "items")
        samples.counters[name] = counter.value;
    }
  }

  const std::vector<BenchCase>& cases_;
  Log& log_;
  std::vector<Samples> samples_;
};

void register_case(const BenchCase& c, std::size_t number, double min_time) {
  auto run = [&c](benchmark::State& state) {
    try {
      c.run(state);
    } catch (const Error& e) {
      state.SkipWithError(e.what());
    }
  };
  benchmark::RegisterBenchmark(std::to_string(number).c_str(), run)->UseManualTime()->MinTime(min_time);
}

}  // namespace

std::vector<BenchResult> run_cases(const std::vector<BenchCase>& cases, int rounds, double min_time, Log& log) {
  for (std::size_t i = 0; i < cases.size(); ++i) register_case(cases[i], i, min_time);
  Collector collector(cases, log);
  collector.rounds = rounds;
  for (collector.round = 1; collector.round <= rounds; ++collector.round)
    benchmark::RunSpecifiedBenchmarks(&collector, ".");
  benchmark::ClearRegisteredBenchmarks();
  log.status("");
  return collector.results();
}

}  // namespace ppm
