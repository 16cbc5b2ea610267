#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "apps/compare/plan.hpp"

namespace ppm {

/// What jobs may use together.
struct Limits {
  int cores = 1;
  int jobs = 0;              ///< side by side; 0: as many as the cores have room for
  double memory_bytes = 0;
};

/// Which job is next: no more threads and expected memory side by side than there is, though a job that alone needs more than all
/// runs alone. It also knows how long jobs take, from those that have run: a job is expected to be like those of its kind (same
/// graph and sequence), else like those of its sequence, else like the mean of all.
class Schedule {
 public:
  /// jobs: to be run; in this order but for those that do not fit.
  Schedule(std::vector<Job> jobs, const Limits& limits);

  /// A job of an earlier part of the suite, or of this one.
  void measured(const Job& job, double wall_s, double peak_rss_bytes);
  /// The next job that fits beside those that run, which runs from now on; null where none does.
  std::optional<Job> start();
  void ended(const Job& job);

  std::size_t waiting() const { return waiting_.size(); }
  std::size_t running() const { return running_.size(); }
  /// Expected until the last job ends; nothing where no job was measured yet.
  std::optional<double> seconds_left(const std::map<int, double>& seconds_of_running) const;
  double expected_memory(const Job& job) const;

 private:
  struct Measured {
    int runs = 0;
    double wall_s = 0, most_bytes = 0;
  };
  bool fits(const Job& job) const;
  std::optional<double> expected_seconds(const Job& job) const;

  std::vector<Job> waiting_;
  std::map<int, Job> running_;
  Limits limits_;
  std::map<std::string, Measured> kinds_, sequences_;
  Measured all_;
};

}  // namespace ppm
