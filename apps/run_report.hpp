#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/accuracy.hpp"
#include "apps/tracking.hpp"
#include "framework/graph/executor.hpp"

namespace ppm {

/// What this part of a run spent on checkpoints.
struct CheckpointCosts {
  std::vector<double> ms;   ///< of each
  std::uint64_t bytes = 0;  ///< of the last
  std::int64_t frame = 0;   ///< frames that were done at the last; 0: there is none
};

/// All that run.json tells.
struct RunReport {
  const Graph& graph;
  const RunSummary& summary;
  const ParticleSet& belief;
  const Metrics& metrics;
  const Workers& workers;
  const Accuracy& accuracy;
  Tracking tracking;
  const CheckpointCosts& checkpoints;
  std::filesystem::path graph_file;
  std::vector<std::string> files;  ///< that the run has written
};

/// run.json, as documented in docs/metrics.md.
std::string run_json(const RunReport& report);

/// The numbers of `ppm evaluate revisits --json`.
std::string revisits_json(const ReprojectionError& error, const RevisitSettings& settings);

/// Trajectory and held-out numbers as in run.json, for `ppm evaluate --json`.
std::string accuracy_json(const Accuracy& accuracy);

/// Image index of the last frame of a run, from its run.json. Throws ConfigError where the folder holds no run.
std::int64_t last_index_of_run(const std::filesystem::path& run);

}  // namespace ppm
