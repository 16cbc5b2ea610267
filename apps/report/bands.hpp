#pragma once
#include <string>
#include <vector>

#include "apps/report/suite_folder.hpp"

namespace ppm::report {

/// A curve over the seeds of a graph: median, smallest and largest at each x that a run has.
struct Band {
  std::vector<double> x, mid, low, high;
};

/// Of the runs that have the curve; empty where none has.
Band over_seeds(const std::vector<const Run*>& runs, const std::string& curve);

/// At most `most` points: neighbours are put together, with the mean of x, the median of mid, the extremes of the
/// bounds. Bounds that were those of a single run stay on the line.
Band thinned(const Band& band, std::size_t most);

/// Median over a window of so many points (odd), smaller at the ends.
std::vector<double> running_median(const std::vector<double>& values, std::size_t window);

}  // namespace ppm::report
