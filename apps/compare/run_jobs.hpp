#pragma once
#include <atomic>
#include <filesystem>
#include <list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/compare/child.hpp"
#include "apps/compare/job_state.hpp"
#include "apps/compare/schedule.hpp"
#include "framework/core/log.hpp"

namespace ppm {

/// Runs jobs of a suite as processes side by side, and keeps the account of each in its folder.
class JobRunner {
 public:
  struct Failure {
    Job job;
    std::string error;
  };
  struct Outcome {
    int done = 0;
    std::vector<Failure> failures;
    bool interrupted = false;
  };

  /// folder: of the suite; program: the ppm that runs jobs, and its build_digest().
  JobRunner(std::filesystem::path folder, std::string program, std::string build, Log& log)
      : folder_(std::move(folder)), program_(std::move(program)), build_(std::move(build)), log_(log) {}

  /// Runs all that waits in the schedule. graphs: the experiments by Job::id. Where `stop` becomes true, jobs that run are ended and
  /// count as not run. A job that fails does not end the others. Throws OutputError where a folder cannot be written.
  Outcome run(Schedule& schedule, const std::map<int, std::string>& graphs, const std::atomic<bool>& stop);

 private:
  struct Running {
    Job job;
    Child child;
    JobState state;
    bool too_long = false;
  };
  void start(const Job& job, const std::string& graph_yaml);
  void wait() const;
  void collect(Schedule& schedule, Outcome& outcome);
  void finish(Running& running, const ChildResult& result, Schedule& schedule, Outcome& outcome);
  void end_all(Schedule& schedule);
  void show(const Schedule& schedule, const Outcome& outcome);

  std::filesystem::path folder_;
  std::string program_, build_;
  Log& log_;
  std::list<Running> running_;
};

}  // namespace ppm
