#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/report/suite_folder.hpp"

namespace ppm::report {

enum class Better { lower, higher, nearer };

/// One number of a run that the report compares. docs/metrics.md defines them.
struct Measure {
  const char* key;    ///< in Run::numbers
  const char* title;  ///< a column's head
  const char* unit;   ///< "" for shares and logs
  double scale;       ///< from the run's unit to this one
  int digits;         ///< behind the point
  Better better;
  double target;  ///< of nearer
  bool telling;   ///< counted in the summary; the others stand in the tables alone
  bool timing;    ///< differs from run to run though the result is the same
};

std::span<const Measure> measures();
const Measure& measure_of(std::string_view key);

/// In the measure's unit. None where the run is not done or has no such number; infinite where a held-out median is
/// null (most pixels were missed).
std::optional<double> value_of(const Run& run, const Measure& measure);
/// A loss is smaller where the value is better.
double loss_of(const Measure& measure, double value);
/// What a run that failed counts as: worse than every other.
double worst(const Measure& measure);

/// With the measure's digits; "failed" for the infinite.
std::string shown(const Measure& measure, double value);
/// "held-out median, mm"
std::string heading(const Measure& measure);

}  // namespace ppm::report
