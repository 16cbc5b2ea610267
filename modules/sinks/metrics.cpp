#include <numbers>
#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/ancestry.hpp"
#include "framework/slam/estimate.hpp"
#include "framework/slam/map_memory.hpp"

namespace ppm {
namespace {

/// Writes all that the nodes recorded, one line a frame, at the end of the run. It adds the source's number of the
/// frame, the spread of the weights and of the poses, and now and then what the maps occupy and how far
/// back the particles' common past lies.
class MetricsCsv final : public Module {
 public:
  In<Belief> belief{this, {{"belief"}, {}, {}}};

  MetricsCsv() {
    params_.add("file", file_).doc("Name of the file.");
    params_.add("memory_every", memory_every_)
        .range(0, 1e9)
        .doc(
            "Records map_bytes_owned (what the maps of all particles occupy together) and map_bytes_alone (what they "
            "would "
            "without sharing) each n-th time; 0 never. It takes some milliseconds with a hundred particles.");
    params_.add("ancestry_every", ancestry_every_)
        .range(0, 1e9)
        .doc(
            "Records the tree of the particles' paths each n-th time: ancestry_nodes (poses in it), branchings, and "
            "coalescence_frames (since the last pose that all share); 0 never.");
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const auto& path = belief->trajectory[best];
    if (!path.empty()) context.metric("frame_index", static_cast<double>(path.last().frame));
    context.metric("particles", static_cast<double>(belief->size()));
    context.metric("ess", belief->ess());
    context.metric("best_log_weight", belief->log_weight[best]);
    const auto poses = spread(*belief);
    context.metric("spread_m", poses.translation_m);
    context.metric("spread_deg", poses.rotation_rad * 180 / std::numbers::pi);
    if (memory_every_ > 0 && ticks_ % memory_every_ == 0) record_memory(context);
    if (ancestry_every_ > 0 && ticks_ % ancestry_every_ == 0) record_ancestry(context);
    ++ticks_;
  }

  void save(RecordWriter& out) const override { out.add(ticks_); }
  void load(RecordReader& in) override { in.take(ticks_); }

  void close(Context& context) override { write_file(context.output(file_), context.metrics().to_csv()); }

 private:
  void record_memory(Context& context) const {
    const auto memory = map_memory(*belief);
    context.metric("map_bytes_owned", static_cast<double>(memory.together));
    context.metric("map_bytes_alone", static_cast<double>(memory.alone));
  }

  void record_ancestry(Context& context) const {
    const auto tree = ancestry(belief->trajectory);
    context.metric("ancestry_nodes", static_cast<double>(tree.nodes));
    context.metric("branchings", static_cast<double>(tree.branchings));
    context.metric("coalescence_frames", static_cast<double>(tree.coalescence_frames));
  }

  std::string file_ = "metrics.csv";
  int memory_every_ = 10, ancestry_every_ = 10;
  std::int64_t ticks_ = 0;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MetricsCsv>("sink.metrics", "Writes the numbers that the nodes recorded, a line a frame, as CSV.",
                         "RFC 4180");
}
