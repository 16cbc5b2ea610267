#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/record_file.hpp"
#include "framework/core/timing.hpp"
#include "framework/graph/graph.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// Wall time of a node, one value a frame in which it ran. In a joint loop over particles the loop's wall time is
/// shared out by the time that each node's ticks took.
struct NodeTimes {
  std::vector<double> ms;
};

/// What a run gives back. Of a run that went on from a checkpoint: the whole, with the part before.
struct RunSummary {
  std::int64_t frames = 0;
  double wall_s = 0;  ///< of the frames and of what is done between them, without open() and close()
  bool interrupted = false;
  std::vector<std::int64_t> resumed;  ///< frames that were done when the run went on, once for each time
  std::map<std::string, NodeTimes> nodes;
};

/// Runs a graph: nodes in file order, frame by frame, until the source ends, `max_frames` are done or `stop` is set
/// (the frame is finished first). Consecutive ParticleModules run as one loop over particles.
class Executor {
 public:
  Executor(Graph& graph, Context& context) : graph_(graph), context_(context) {}
  /// Called after each frame with (frames done, frames expected or 0).
  std::function<void(std::int64_t, std::int64_t)> on_frame;
  /// Called where `stop` ends the run, after at least one frame and before the nodes that run at the end.
  std::function<void()> on_stop;

  RunSummary run(std::int64_t max_frames, const std::atomic<bool>& stop);
  /// Writes all that run() needs to go on after the frames that are done. Valid in on_frame and on_stop.
  void save(RecordFileWriter& file) const;
  /// Opens the nodes and puts them, the belief and the metrics into the state that save() wrote: run() goes on from
  /// there. Throws what opening throws, and DataError where the state does not fit.
  void load(RecordFileReader& file);
  /// Frames that are done.
  std::int64_t frames() const { return summary_.frames; }
  const ParticleSet& belief() const { return *graph_.belief_; }

 private:
  void open_nodes();
  bool tick_frame(std::int64_t frame);
  void tick_at_end(std::int64_t frame);
  void close_nodes();
  void tick_node(std::size_t i);
  /// Returns the node after the loop. frame: of the loop, or none at the end.
  std::size_t tick_loop(std::size_t first, const std::function<bool(const Node&)>& runs,
                        std::optional<std::int64_t> frame);
  /// Whether a prediction that is there before node `next` of this frame may be read before another one is made.
  bool prediction_is_read(std::size_t next, std::int64_t frame) const;
  static bool has_output(const Node& node);
  /// Empties the outputs, so that a module that forgets to set one is found out; gives what was there.
  static std::vector<std::pair<PortBase*, std::shared_ptr<const void>>> take_outputs(const Node& node);
  static void pass_through(const Node& node);
  // executor_state.cpp
  bool prediction_stands() const;
  std::map<std::string, PortBase*> values_for_the_end() const;
  void save_values(RecordFileWriter& file) const;
  void load_values(RecordFileReader& file);
  std::int64_t expected_frames() const;

  Graph& graph_;
  Context& context_;
  struct PredictionUse {
    bool needs = false, gives = false, drops = false;  // the facet, or a part of it
  };
  std::vector<PredictionUse> prediction_use_;  // by node
  std::vector<Context> contexts_;  // one a node, copies of context_: nodes of one loop run at the same time
  RunSummary summary_;
  double wall_before_s_ = 0;  // of the parts of the run before it went on
  Stopwatch watch_;           // of this part
  bool opened_ = false;
};

}  // namespace ppm
