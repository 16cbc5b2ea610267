#pragma once
#include <map>
#include <string>
#include <vector>

#include "apps/bench/bench_case.hpp"
#include "framework/core/log.hpp"

namespace ppm {

/// What was measured of a case.
struct BenchResult {
  const BenchCase* of = nullptr;
  double ms = 0;                           ///< wall time of one item, median over the rounds
  double ms_best = 0;                      ///< the least of them
  double cpu_ms = 0;                       ///< of the process for an item, median; 0 where it is not counted
  std::map<std::string, double> counters;  ///< further numbers, of the last round
  std::string left_out;                    ///< why there is no number; empty where there is one
};

/// Times all cases with Google Benchmark, one after the other, and all of them again in each round, so that what
/// disturbs the machine for a while disturbs all alike. min_time: s, least time of a case in a round. The results are
/// in the order of the cases, which must outlive them.
std::vector<BenchResult> run_cases(const std::vector<BenchCase>& cases, int rounds, double min_time, Log& log);

}  // namespace ppm
