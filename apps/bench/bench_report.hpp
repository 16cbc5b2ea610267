#pragma once
#include <string>
#include <vector>

#include "apps/bench/bench_run.hpp"
#include "apps/bench/kernel_work.hpp"

namespace ppm {

/// What the results are of.
struct BenchSession {
  std::string processor;
  int threads = 1, rounds = 1;
  bool quick = false;
  double texel_size_m = 0;  ///< of the maps
};

/// One line a case.
std::string result_table(const std::vector<BenchResult>& results);
/// The same work by each back-end, side by side, with times as multiples of those of prediction.embree in this run;
/// empty where less than two back-ends were timed.
std::string ratio_table(const std::vector<BenchResult>& results);
std::string bench_json(const BenchSession& session, const std::vector<BenchResult>& results,
                       const std::vector<KernelShare>& kernels);

}  // namespace ppm
