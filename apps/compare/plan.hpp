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
  std::string experiment;  ///< digest of all that the run is a function of: composed graph, seed, views; and of its threads

  /// "comparison/sequence/graph/seed"
  std::string name() const;
  /// What jobs that differ in the seed alone have in common.
  std::string kind() const { return comparison + "/" + sequence + "/" + graph; }
};

/// A job with the experiment that it runs.
struct PlannedJob {
  Job job;
  std::string graph_yaml;
};

/// All runs of a suite, in the order of the file, seeds last.
struct Plan {
  Suite suite;
  std::vector<PlannedJob> jobs;
};

/// Composes every graph of a suite with every sequence and checks the results as `ppm check` does. Throws one ConfigError with
/// every mistake. plugins: libraries that every graph is run with, besides its own.
Plan make_plan(Suite suite, const std::vector<std::filesystem::path>& plugins);

/// A name as a part of a path: letters, digits and "_.=,-" stay, a run of others becomes one '_'.
std::string folder_name(const std::string& name);

}  // namespace ppm
