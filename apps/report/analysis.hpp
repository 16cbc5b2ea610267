#pragma once
#include <utility>
#include <vector>

#include "apps/report/claims.hpp"
#include "apps/report/plots.hpp"

namespace ppm::report {

/// All that the report says of one comparison, computed once for its four forms.
struct Analysis {
  explicit Analysis(const Comparison& c);

  const Comparison& comparison;
  std::vector<Difference> differences;
  std::vector<EqualCost> equal_costs;
  std::vector<Claim> claims;
  std::vector<Tally> tallies;
  std::vector<std::pair<const SequenceEntry*, std::vector<Plot>>> plots;
};

/// Measures that stand in one table: of the held-out frames from the reference's poses, and so on.
struct MeasureGroup {
  const char* title;
  std::vector<const Measure*> measures;
};
/// The groups, with those measures that some run of the sequence has; groups without any are left out.
std::vector<MeasureGroup> measure_groups(const Comparison& comparison, const std::string& sequence);

}  // namespace ppm::report
