#include "apps/report/analysis.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace ppm::report {

namespace {

struct Heading {
  const char* title;
  std::array<std::string_view, 4> sections;  ///< of run.json
};

constexpr std::array kHeadings{
    Heading{"Held-out depth, from the reference's poses", {"holdout"}},
    Heading{"Held-out depth, from the poses that were found", {"holdout_estimated"}},
    Heading{"Path", {"trajectory", "trajectory_online", "revisits", "tracking"}},
    Heading{"Surface", {"surface"}},
    Heading{"Cost", {"map", "job", "times", "fps"}},
};

std::string_view section_of(const Measure& measure) {
  const std::string_view key = measure.key;
  return key.substr(0, key.find('.'));
}

}  // namespace

Analysis::Analysis(const Comparison& c)
    : comparison(c),
      differences(differences_of(c)),
      equal_costs(report::equal_costs(c)),
      claims(claims_of(c, differences, equal_costs)),
      tallies(tallies_of(c, differences)) {
  for (const auto& sequence : c.sequences) plots.emplace_back(&sequence, plots_of(c, sequence));
}

std::vector<MeasureGroup> measure_groups(const Comparison& comparison, const std::string& sequence) {
  std::vector<MeasureGroup> groups;
  for (const auto& heading : kHeadings) {
    MeasureGroup group{heading.title, {}};
    for (const auto& measure : measures()) {
      if (std::ranges::find(heading.sections, section_of(measure)) == heading.sections.end()) continue;
      const bool any = std::ranges::any_of(
          comparison.runs, [&](const Run& run) { return run.sequence == sequence && value_of(run, measure); });
      if (any) group.measures.push_back(&measure);
    }
    if (!group.measures.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ppm::report
