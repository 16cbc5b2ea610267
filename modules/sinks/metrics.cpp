#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/map_memory.hpp"

namespace ppm {
namespace {

/// Writes all that the nodes recorded, one line a frame, at the end of the run. It adds the source's number of the
/// frame, the spread of the weights, and now and then what the maps occupy.
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
  }

  void tick(Context& context) override {
    const auto best = belief->best();
    const auto& path = belief->trajectory[best];
    if (!path.empty()) context.metric("frame_index", static_cast<double>(path.last().frame));
    context.metric("particles", static_cast<double>(belief->size()));
    context.metric("ess", belief->ess());
    context.metric("best_log_weight", belief->log_weight[best]);
    if (memory_every_ > 0 && ticks_++ % memory_every_ == 0) record_memory(context);
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

  std::string file_ = "metrics.csv";
  int memory_every_ = 10;
  std::int64_t ticks_ = 0;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MetricsCsv>("sink.metrics", "Writes the numbers that the nodes recorded, a line a frame, as CSV.",
                         "RFC 4180");
}
