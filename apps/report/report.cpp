#include "apps/report/report.hpp"

#include "apps/report/outputs.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

void write_report(const std::filesystem::path& suite_folder) {
  const auto suite = report::read_suite(suite_folder);
  std::vector<report::Analysis> analyses;
  for (const auto& comparison : suite.comparisons) analyses.emplace_back(comparison);
  write_file(suite_folder / "report.html", report::page(suite, analyses));
  write_file(suite_folder / "report.json", report::numbers(suite, analyses));
  write_file(suite_folder / "report.md", report::digest(suite, analyses));
  write_file(suite_folder / "runs.csv", report::runs_table(suite));
}

}  // namespace ppm
