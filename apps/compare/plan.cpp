#include "apps/compare/plan.hpp"

#include <cctype>

#include "apps/compare/planner.hpp"
#include "framework/core/digest.hpp"

namespace ppm {

std::string Job::name() const {
  return fmt::format("{}/{}", kind(), seed);
}

std::string experiment_digest(const Job& job, const std::string& graph_yaml) {
  Digest digest;
  digest.add(graph_yaml);
  digest.add(job.seed);
  digest.add(job.views);
  digest.add(job.threads);
  return digest.hex();
}

std::string folder_name(const std::string& name) {
  constexpr std::size_t kMost = 200;  // file systems take 255 bytes
  static const std::string plain_marks = "_.=,-";
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || plain_marks.find(c) != std::string::npos;
    if (plain) out += c;
    if (!plain && !out.empty() && out.back() != '_') out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.substr(0, kMost);
}

Plan make_plan(Suite suite) {
  Plan plan{std::move(suite), {}, {}};
  Planner planner(plan);
  for (auto& comparison : plan.suite.comparisons) planner.add(comparison);
  planner.report_unknown_drops();
  if (!planner.mistakes().empty()) throw ConfigError(std::move(planner.mistakes()));
  return plan;
}

}  // namespace ppm
