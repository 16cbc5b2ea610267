#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/compare/plan.hpp"

namespace ppm {

/// How a job stands, as its folder's job.json tells.
struct JobState {
  enum class Status { running, done, failed };
  Status status = Status::running;
  int exit_code = 0;  ///< 128 + the signal where one ended it
  double wall_s = 0, cpu_s = 0;
  double peak_rss_bytes = 0;
  std::uint64_t seed = 0;
  int threads = 1;
  std::vector<std::string> command;
  std::string error;       ///< why it failed, with the last lines of its log
  std::string experiment;  ///< Job::experiment
  std::string build;       ///< build_digest() of the ppm that ran it
};

/// Null where there is no job.json, or one that cannot be read.
std::optional<JobState> read_job_state(const std::filesystem::path& folder);
void write_job_state(const std::filesystem::path& folder, const JobState& state);

/// The job counts as not run.
void remove_job_state(const std::filesystem::path& folder);
/// Makes the folder of a job that is to be run, with its experiment and nothing else. Throws OutputError.
void prepare_job(const std::filesystem::path& folder, const std::string& graph_yaml);
/// The experiment of a job that was prepared. Throws ConfigError where it is not the one of the plan.
std::string read_experiment(const std::filesystem::path& folder, const Job& job);

/// True where a job need not run again: it is done, was the same experiment, and (build not empty) was run by that build.
bool is_done(const std::optional<JobState>& state, const Job& job, const std::string& build);

/// The last lines of a text file, for messages.
std::string last_lines(const std::filesystem::path& file, int lines);

inline constexpr const char* kJobLog = "log.txt";
inline constexpr const char* kJobGraph = "graph.yaml";

}  // namespace ppm
