#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/report/measures.hpp"
#include "apps/report/statistics.hpp"

namespace ppm::report {

/// Whether a run that is done had lost the camera when it ended.
bool lost_at_end(const Run& run);

/// One graph on one sequence: what became of its runs.
struct Outcome {
  int done = 0, failed = 0, waiting = 0;  ///< waiting: not run yet, or running
  int lost = 0;                           ///< of those done: lost in the end
};
Outcome outcome_of(const std::vector<const Run*>& runs);

/// Two runs or more are done, none failed, and all ended in the same belief, byte for byte.
bool seed_free(const std::vector<const Run*>& runs);

/// One measure of one graph on one sequence over its seeds.
struct Cell {
  std::vector<double> values;        ///< by seed; a run that failed has the worst value
  double median = 0;                 ///< of them
  std::optional<Interval> interval;  ///< none: one run, or the seed changes nothing
  bool seed_free = false;
};
/// None where no run has the measure.
std::optional<Cell> cell_of(const std::vector<const Run*>& runs, const Measure& measure);

/// "8.32 [8.30, 8.35]"; "8.32 =" where the seed changes nothing.
std::string shown(const Measure& measure, const Cell& cell);

}  // namespace ppm::report
