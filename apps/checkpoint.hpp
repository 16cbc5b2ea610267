#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/core/record_file.hpp"
#include "framework/graph/executor.hpp"

namespace ppm {

/// What a run was started as, as a checkpoint keeps it.
struct RunStart {
  std::string experiment;            ///< Graph::experiment_yaml()
  std::filesystem::path graph_file;  ///< that the user named
  std::int64_t max_frames = 0;
  std::vector<std::string> files;  ///< written so far
};

/// Writes a checkpoint, in place of an earlier one once it is complete; gives its bytes. Call between frames.
/// Throws OutputError; ConfigError where the belief has maps of a kind that cannot be kept.
std::uint64_t write_checkpoint(const std::filesystem::path& file, const RunStart& start, const Executor& executor);

/// The checkpoint of a run that is to go on.
class Checkpoint {
 public:
  /// Reads the file of a run's folder. Throws ConfigError where there is none; DataError where it is damaged, of another version
  /// or written by another build of ppm.
  explicit Checkpoint(const std::filesystem::path& run);

  const RunStart& start() const { return start_; }
  /// Throws ConfigError where the graph, read from `file`, is not the one that the checkpoint is of: results depend on it.
  void check_graph(const Graph& graph, const std::filesystem::path& file) const;
  /// Puts the executor into the state of the checkpoint. Once.
  void restore(Executor& executor);

 private:
  RecordFileReader file_;
  RunStart start_;
};

}  // namespace ppm
