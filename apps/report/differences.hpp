#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/report/cells.hpp"

namespace ppm::report {

enum class Verdict { worse, tie, better };
const char* to_string(Verdict verdict);

/// What a verdict rests on.
enum class Basis {
  exact,     ///< the seed changes neither graph's result
  interval,  ///< the confidence interval of the paired differences, at 90 % or more (five seeds or more)
  few,       ///< the same with fewer pairs
  single     ///< one run of each
};
const char* to_string(Basis basis);

/// Subject minus other in one measure on one sequence, paired by seed.
struct Difference {
  std::string sequence, other;
  const Measure* measure = nullptr;
  std::vector<double>
      differences;    ///< by seed, in the measure's unit; of `nearer` measures: of the distances to the target
  double median = 0;  ///< of them; infinite where a run of one of the two failed
  std::optional<Interval> interval;  ///< of that median
  double p = 1;                      ///< of the exact sign test, two-sided
  double subject = 0, opponent = 0;  ///< medians over the pairs
  Verdict verdict = Verdict::tie;
  Basis basis = Basis::single;

  /// By how much the subject is worse, for sorting: log of the ratio of the losses; of log densities the difference.
  double severity() const;
  /// Counted as win or loss: the others only lean one way.
  bool decided() const { return basis == Basis::exact || basis == Basis::interval; }
};

/// None where no seed has both, or neither is measured.
std::optional<Difference> difference_of(const Comparison& comparison, const std::string& sequence,
                                        const std::string& other, const Measure& measure);

/// Of all sequences, other graphs and telling measures, the worst first.
std::vector<Difference> differences_of(const Comparison& comparison);

/// Wins, losses and ties of the subject against one graph.
struct Tally {
  std::string other;
  int better = 0, tie = 0, worse = 0;     ///< decided
  int leans_better = 0, leans_worse = 0;  ///< not decided
};
std::vector<Tally> tallies_of(const Comparison& comparison, const std::vector<Difference>& differences);

}  // namespace ppm::report
