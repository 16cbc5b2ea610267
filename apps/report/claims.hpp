#pragma once
#include <string>
#include <vector>

#include "apps/report/differences.hpp"
#include "apps/report/equal_cost.hpp"

namespace ppm::report {

/// open: the runs do not say, since a front does not reach so far, or seeds are too few.
enum class Holds { no, open, yes };
const char* to_string(Holds holds);

/// What people hope of the subject against the graph that the comparison names, and whether it is so.
struct Claim {
  std::string sequence;  ///< "" of all
  std::string text, number;
  Holds holds = Holds::open;
  double severity = 0;  ///< larger: further from holding
};

/// Those that fail first. None where the comparison names no opponent.
std::vector<Claim> claims_of(const Comparison& comparison, const std::vector<Difference>& differences,
                             const std::vector<EqualCost>& equal);

/// "0.42", "at most 0.42", "at least 0.42"
std::string shown(const Reading& reading);

}  // namespace ppm::report
