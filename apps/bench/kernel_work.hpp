#pragma once
#include <string>
#include <vector>

#include "apps/bench/bench_run.hpp"

namespace ppm {

/// How near a kernel comes to what the machine can do.
struct KernelShare {
  std::string kernel;
  double ms = 0;                           ///< of one view or particle, one thread
  double flops = 0, bytes = 0;             ///< that the work takes at least, counted from the scene; see `basis`
  double flops_share = 0, read_share = 0;  ///< of the roofs of one thread; 0 where no roof was measured
  std::string basis;                       ///< what was counted, in words
};

/// The three kernels that a frame's time goes into, by the fastest back-end, on the plan's map of 100,000 triangles
/// (its first one where it has none). Kernels whose cases are not among the results are left out.
std::vector<KernelShare> kernel_shares(const BenchPlan& plan, const std::vector<BenchResult>& results);
std::string kernel_table(const std::vector<KernelShare>& shares);

}  // namespace ppm
