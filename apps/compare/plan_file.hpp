#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/compare/plan.hpp"

namespace ppm {

/// The name of the suite whose plan lies in a folder; "" where there is none.
std::string name_in_plan(const std::filesystem::path& folder);

/// Writes suite.json: the whole plan, as docs/compare.md describes it. program: the executable of the runs.
void write_plan(const std::filesystem::path& folder, const Plan& plan, const std::string& program);
/// The jobs of suite.json. Throws ConfigError where there is none, or it is not as write_plan() writes it.
std::vector<Job> read_jobs(const std::filesystem::path& folder);

/// The command that runs a job.
std::vector<std::string> command_of(const Job& job, const std::filesystem::path& suite_folder, const std::string& program);

}  // namespace ppm
