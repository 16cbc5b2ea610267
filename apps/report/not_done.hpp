#pragma once
#include <string>
#include <vector>

#include "apps/report/suite_folder.hpp"

namespace ppm::report {

/// Runs of one graph on one sequence that are missing, or running.
struct NotDone {
  std::string sequence, graph;
  RunStatus status = RunStatus::missing;
  std::vector<std::uint64_t> seeds;  ///< ascending
};
/// In the order of the comparison's runs.
std::vector<NotDone> not_done(const Comparison& comparison);

/// "seed 3", "seeds 1, 2", "seeds 1, 3 to 5". Seeds ascend.
std::string seeds_text(const std::vector<std::uint64_t>& seeds);

/// "7 of 30 runs are not done: on kitchen seeds 2, 3 of 3 graphs; on room seed 5 of PPM." "" where all are.
std::string not_done_sentence(const Comparison& comparison);

}  // namespace ppm::report
