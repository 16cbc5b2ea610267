#pragma once
#include <filesystem>
#include <string>

#include "apps/compare/plan.hpp"

namespace ppm {

/// The script of a Slurm job array that runs a suite whose plan lies in `folder`, one task a run (of more than kMostTasks runs, several
/// a task). Each task asks for the threads, the memory and the time of the run that needs most of each. Paths and PPM_DATA are those of
/// now: the tasks start in the current folder.
std::string slurm_script(const Plan& plan, const std::filesystem::path& folder, const std::string& program);

/// Slurm's own limit to the index of a task is 1000, where the cluster has not set another (MaxArraySize).
inline constexpr int kMostTasks = 1000;

}  // namespace ppm
