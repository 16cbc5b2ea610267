#pragma once
#include <string>
#include <vector>

#include "apps/report/analysis.hpp"

namespace ppm::report {

/// report.html: one file without network or scripts.
std::string page(const Suite& suite, const std::vector<Analysis>& analyses);
/// report.json: every number behind tables and plots. What is infinite is null.
std::string numbers(const Suite& suite, const std::vector<Analysis>& analyses);
/// runs.csv: a line a run, with all scalars that it left.
std::string runs_table(const Suite& suite);
/// report.md: what was to be shown, losses, and the tables.
std::string digest(const Suite& suite, const std::vector<Analysis>& analyses);

}  // namespace ppm::report
