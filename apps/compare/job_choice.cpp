#include "apps/compare/job_choice.hpp"

#include <algorithm>
#include <array>
#include <fnmatch.h>
#include <map>
#include <sstream>

namespace ppm {

namespace {

bool fits(const std::string& pattern, const std::string& text) {
  return pattern == text || ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

}  // namespace

bool is_meant(const Job& job, const std::string& pattern) {
  const std::array<std::string, 4> parts{job.comparison, job.sequence, job.graph, std::to_string(job.seed)};
  std::istringstream in(pattern);
  std::size_t i = 0;
  for (std::string part; std::getline(in, part, '/'); ++i) {
    if (i == parts.size()) return false;
    if (!fits(part, parts[i]) && !(i == 2 && fits(part, job.folder.parent_path().filename().string()))) return false;
  }
  return true;
}

std::vector<Job> in_order_of_seeds(std::vector<Job> jobs) {
  std::map<std::string, int> seen;
  std::map<int, int> rank;  // by Job::id
  for (const auto& job : jobs) rank[job.id] = seen[job.kind()]++;
  std::ranges::stable_sort(jobs, {}, [&](const Job& job) { return rank[job.id]; });
  return jobs;
}

}  // namespace ppm
