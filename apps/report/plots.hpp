#pragma once
#include <vector>

#include "apps/report/equal_cost.hpp"
#include "apps/report/svg_plot.hpp"

namespace ppm::report {

/// The plots of one sequence; those that no run has curves for are left out.
///   error of the path against time; held-out error against frames, by kind of poses; calibration; map memory and CPU
///   time against frames; held-out error against memory and against time
std::vector<Plot> plots_of(const Comparison& comparison, const SequenceEntry& sequence);

}  // namespace ppm::report
