#include "apps/compare/schedule.hpp"

#include <algorithm>

namespace ppm {

Schedule::Schedule(std::vector<Job> jobs, const Limits& limits) : waiting_(std::move(jobs)), limits_(limits) {}

void Schedule::measured(const Job& job, double wall_s, double peak_rss_bytes) {
  for (auto* m : {&kinds_[job.kind()], &sequences_[job.comparison + "/" + job.sequence], &all_}) {
    ++m->runs;
    m->wall_s += wall_s;
    m->most_bytes = std::max(m->most_bytes, peak_rss_bytes);
  }
}

double Schedule::expected_memory(const Job& job) const {
  const auto measured = kinds_.find(job.kind());
  return measured == kinds_.end() ? job.memory_bytes : measured->second.most_bytes;
}

bool Schedule::fits(const Job& job) const {
  if (running_.empty()) return true;
  if (limits_.jobs > 0 && static_cast<int>(running_.size()) >= limits_.jobs) return false;
  int threads = job.threads;
  double bytes = expected_memory(job);
  for (const auto& [id, other] : running_) {
    threads += other.threads;
    bytes += expected_memory(other);
  }
  return (limits_.jobs > 0 || threads <= limits_.cores) && bytes <= limits_.memory_bytes;
}

std::optional<Job> Schedule::start() {
  const auto next = std::ranges::find_if(waiting_, [&](const Job& job) { return fits(job); });
  if (next == waiting_.end()) return std::nullopt;
  Job job = std::move(*next);
  waiting_.erase(next);
  running_.emplace(job.id, job);
  return job;
}

void Schedule::ended(const Job& job) {
  running_.erase(job.id);
}

std::optional<double> Schedule::expected_seconds(const Job& job) const {
  const auto kind = kinds_.find(job.kind());
  const auto sequence = sequences_.find(job.comparison + "/" + job.sequence);
  const Measured& m = kind != kinds_.end() ? kind->second : sequence != sequences_.end() ? sequence->second : all_;
  if (m.runs == 0) return std::nullopt;
  return m.wall_s / m.runs;
}

std::optional<double> Schedule::seconds_left(const std::map<int, double>& seconds_of_running) const {
  double sum = 0, longest = 0;
  int threads = 0;
  auto add = [&](const Job& job, double passed) {
    const auto expected = expected_seconds(job);
    if (!expected) return false;
    const double left = std::max(0.0, *expected - passed);
    sum += left;
    longest = std::max(longest, left);
    threads = std::max(threads, job.threads);
    return true;
  };
  for (const auto& job : waiting_)
    if (!add(job, 0)) return std::nullopt;
  for (const auto& [id, job] : running_) {
    const auto passed = seconds_of_running.find(id);
    if (!add(job, passed == seconds_of_running.end() ? 0 : passed->second)) return std::nullopt;
  }
  const int beside = limits_.jobs > 0 ? limits_.jobs : std::max(1, limits_.cores / std::max(1, threads));
  return std::max(longest, sum / beside);
}

}  // namespace ppm
