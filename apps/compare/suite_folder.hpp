#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/compare/plan.hpp"

namespace ppm {

/// Makes the folder of a suite. Throws ConfigError where it is a file, or holds other things than this suite; OutputError where it
/// cannot be made.
void make_suite_folder(const std::filesystem::path& folder, const Suite& suite);

/// Held while jobs of a suite folder run; the runs inherit it, so that it is held until the last of them has ended, also where
/// `ppm compare` itself was killed.
class SuiteLock {
 public:
  enum class Kind { alone, one_of_many };
  /// Throws OutputError where others hold it: anyone for `alone`, someone alone for `one_of_many`.
  SuiteLock(const std::filesystem::path& folder, Kind kind);
  ~SuiteLock();
  SuiteLock(const SuiteLock&) = delete;
  SuiteLock& operator=(const SuiteLock&) = delete;

 private:
  int fd_ = -1;
};

/// Writes suite.json: the whole plan, as docs/compare.md describes it. program: the executable of the runs.
void write_plan(const std::filesystem::path& folder, const Plan& plan, const std::string& program);
/// The jobs of suite.json. Throws ConfigError where there is none, or it is not as write_plan() writes it.
std::vector<Job> read_jobs(const std::filesystem::path& folder);

/// The command that runs a job.
std::vector<std::string> command_of(const Job& job, const std::filesystem::path& suite_folder, const std::string& program);

}  // namespace ppm
