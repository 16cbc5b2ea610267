#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "framework/core/log.hpp"
#include "framework/core/parallel.hpp"
#include "framework/core/rng.hpp"
#include "framework/graph/metrics.hpp"

namespace ppm {

/// What a module may ask of the run that it is part of. No look-up of other modules.
class Context {
 public:
  Context(const Workers& workers, Log& log, Metrics& metrics, std::uint64_t seed, std::filesystem::path out_dir)
      : workers_(workers), log_(log), metrics_(metrics), seed_(seed), out_dir_(std::move(out_dir)) {}

  /// Number of the frame in this run, from 0 (the source's own number is Frame::index).
  std::int64_t frame() const { return frame_; }
  /// Random numbers for one particle in this frame, keyed by (seed, frame, node, purpose, particle).
  Rng rng(std::string_view purpose, std::size_t particle = 0) const;
  const Workers& workers() const { return workers_; }
  int threads() const { return workers_.threads(); }
  Log& log() const { return log_; }
  /// Records a number of this node and frame: column "node.name" in the metrics.
  void metric(std::string_view name, double value);
  const Metrics& metrics() const { return metrics_; }
  /// Name of the node that is running.
  const std::string& node() const { return node_; }
  /// A file of the run directory, for sinks. Throws InternalError where the run has no directory.
  std::filesystem::path output(const std::string& file_name) const;
  /// A source says that there is no further frame: nothing below it runs in this tick, and the run closes.
  void end_of_stream() { ended_ = true; }
  /// A source says how many frames it will give, for progress.
  void expect_frames(std::int64_t n) { expected_frames_ = n; }

 private:
  friend class Executor;
  friend class Harness;
  void enter(const std::string& node);

  const Workers& workers_;
  Log& log_;
  Metrics& metrics_;
  std::uint64_t seed_;
  std::filesystem::path out_dir_;
  std::string node_;
  std::uint32_t node_key_ = 0;
  std::int64_t frame_ = 0;
  std::int64_t expected_frames_ = 0;
  bool ended_ = false;
};

}  // namespace ppm
