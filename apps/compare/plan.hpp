#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/compare/suite.hpp"

namespace ppm {

/// One run of a suite.
struct Job {
  int id = 0;
  std::string comparison, sequence, graph;
  std::uint64_t seed = 0;
  std::filesystem::path folder;  ///< in the suite's folder: runs/COMPARISON/SEQUENCE/GRAPH/seed_N
  int threads = 1, views = 0;
  double memory_bytes = 0, time_limit_s = 0;
  std::string experiment;  ///< experiment_digest()

  /// "comparison/sequence/graph/seed"
  std::string name() const;
  /// What jobs that differ in the seed alone have in common.
  std::string kind() const { return comparison + "/" + sequence + "/" + graph; }
};

/// Digest of all that a run's results are a function of beside the data, and of what its times depend on: the composed graph, seed,
/// views and threads.
std::string experiment_digest(const Job& job, const std::string& graph_yaml);

/// A job with the experiment that it runs.
struct PlannedJob {
  Job job;
  std::string graph_yaml;
};

/// An optional graph that this ppm cannot run.
struct LeftOut {
  std::string comparison, graph, reason;
};

/// All runs of a suite, in the order of the file, seeds last. Graphs that are left out are no longer among those of `suite`.
struct Plan {
  Suite suite;
  std::vector<PlannedJob> jobs;
  std::vector<LeftOut> left_out;
};

/// Composes every graph of a suite with every sequence and checks the results as `ppm check` does. Throws one ConfigError with
/// every mistake, each once, however many compositions have it.
Plan make_plan(Suite suite);

/// A name as a part of a path: letters, digits and "_.=,-" stay, a run of others becomes one '_'.
std::string folder_name(const std::string& name);

}  // namespace ppm
