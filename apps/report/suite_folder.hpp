#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ppm::report {

/// Points (x, y), ascending in x.
struct Curve {
  std::vector<double> x, y;
};

/// One held-out frame in pictures. Paths are relative to the suite's folder.
struct View {
  std::int64_t frame = 0;
  std::string poses;
  std::filesystem::path measured, predicted, error;
};

/// done: it left its results. missing: nobody has run it yet.
enum class RunStatus { done, failed, running, missing };
const char* to_string(RunStatus status);

/// What one run left. Of runs that are not done only the first block is set.
struct Run {
  std::string id, sequence, graph;
  std::uint64_t seed = 0;
  std::filesystem::path folder;      ///< relative to the suite's
  std::vector<std::string> command;  ///< as it would be given in the suite's folder
  RunStatus status = RunStatus::missing;
  std::string error;  ///< why it failed

  std::map<std::string, double>
      numbers;  ///< scalars of run.json by path ("holdout.median_mm"), those of job.json as "job.NAME"; null: NaN
  std::map<std::string, std::string> texts;  ///< likewise
  std::map<std::string, Curve> curves;       ///< over frames or time: see read_curves()
  std::map<std::string, Curve> calibration;  ///< "holdout", "holdout_estimated": nominal -> measured
  std::vector<View> views;
};

struct GraphEntry {
  std::string name, title;
  std::string family,
      family_title;  ///< of a sweep: its points, first to last, are a line in the plots of error against cost
  std::map<std::string, std::string> sweep;  ///< node.key: value; empty: no sweep
};

struct SequenceEntry {
  std::string name, title;
};

struct Comparison {
  std::string name, title, subject, against;
  std::vector<SequenceEntry> sequences;
  std::vector<GraphEntry> graphs;
  std::vector<Run> runs;

  /// Runs of one graph on one sequence, by seed.
  std::vector<const Run*> runs_of(const std::string& sequence, const std::string& graph) const;
  const GraphEntry& graph(const std::string& name) const;
};

struct Suite {
  std::filesystem::path folder;
  std::string name, title;
  std::string file, text;  ///< the suite's own: name without folder, and content
  std::string version;
  std::vector<std::pair<std::string, std::string>> machine;  ///< in words
  std::vector<Comparison> comparisons;
};

/// Reads the folder of a suite. Throws ConfigError where it is none, DataError where a file of a finished run cannot be
/// read.
Suite read_suite(const std::filesystem::path& folder);

/// The composed graph of a run (graph.yaml); "" where it has none yet.
std::string graph_text(const Suite& suite, const Run& run);

}  // namespace ppm::report
