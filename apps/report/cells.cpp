#include "apps/report/cells.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace ppm::report {

bool lost_at_end(const Run& run) {
  const auto lost = run.numbers.find("tracking.lost_at_end");
  return lost != run.numbers.end() && lost->second == 1;
}

Outcome outcome_of(const std::vector<const Run*>& runs) {
  Outcome outcome;
  for (const auto* run : runs) {
    outcome.done += run->status == RunStatus::done;
    outcome.failed += run->status == RunStatus::failed;
    outcome.waiting += run->status == RunStatus::running || run->status == RunStatus::missing;
    outcome.lost += lost_at_end(*run);
  }
  return outcome;
}

bool seed_free(const std::vector<const Run*>& runs) {
  std::vector<std::string> digests;
  for (const auto* run : runs) {
    if (run->status == RunStatus::failed) return false;
    if (run->status != RunStatus::done) continue;
    const auto digest = run->texts.find("digest");
    if (digest == run->texts.end()) return false;
    digests.push_back(digest->second);
  }
  return digests.size() >= 2 && std::ranges::all_of(digests, [&](const auto& d) { return d == digests.front(); });
}

std::optional<Cell> cell_of(const std::vector<const Run*>& runs, const Measure& measure) {
  Cell cell;
  bool any = false;
  for (const auto* run : runs) {
    const auto value = value_of(*run, measure);
    any = any || value;
    if (value) cell.values.push_back(*value);
    if (run->status == RunStatus::failed) cell.values.push_back(worst(measure));
  }
  if (!any) return std::nullopt;
  cell.median = median(cell.values);
  cell.seed_free = !measure.timing && seed_free(runs);
  if (!cell.seed_free) cell.interval = median_interval(cell.values);
  return cell;
}

std::string shown(const Measure& measure, const Cell& cell) {
  const auto middle = shown(measure, cell.median);
  if (cell.seed_free) return middle + " =";
  if (!cell.interval) return middle;
  return fmt::format("{} [{}, {}]", middle, shown(measure, cell.interval->low), shown(measure, cell.interval->high));
}

}  // namespace ppm::report
