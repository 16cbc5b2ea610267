#pragma once
#include <chrono>
#include <vector>

namespace ppm {

/// Wall clock since construction or the last reset.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double ms() const { return 1e3 * seconds(); }
  void reset() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// The q-quantile (nearest rank, q in [0, 1]) of the values; NaN where there are none. Takes a copy: it sorts.
double quantile(std::vector<double> values, double q);
/// Arithmetic mean; NaN where there are none.
double mean(const std::vector<double>& values);

}  // namespace ppm
