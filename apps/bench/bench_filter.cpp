#include "apps/bench/bench_filter.hpp"

#include <algorithm>
#include <atomic>

#include "apps/bench/bench_modules.hpp"
#include "framework/core/process_cost.hpp"
#include "framework/graph/executor.hpp"

namespace ppm {
namespace {

constexpr int kTurns = 3;  // of the cycle, the first one unmeasured

std::string node(const std::string& name, const std::string& module, const std::string& params, bool frame = true,
                 int every = 1) {
  if (module.empty()) return "";
  return fmt::format("  - {{name: {}, module: {}, {}when: {{from_frame: 1, every: {}}}, params: {}}}\n", name, module,
                     frame ? "in: {frame: camera.frame}, " : "", every, params);
}

std::string graph_of(const BenchFilter& f) {
  std::string text = "name: bench\nseed: 1\nnodes:\n  - {name: camera, module: source.bench}\n";
  text += fmt::format(
      "  - {{name: init, module: map.bench, in: {{frame: camera.frame}}, when: {{until_frame: 0}}, "
      "params: {{particles: {}, own: {}}}}}\n",
      f.particles, f.own_maps);
  text += node("motion", "motion.reference_pose", f.jitter);
  text += node("look", f.look, f.look_params);
  text += node("weigh", f.weigh, f.weigh_params, f.weigh != "weighting.bench_fill");
  if (f.ess_below > 0)
    text += node("pick", "resampling.systematic", fmt::format("{{ess_below: {}}}", f.ess_below), false);
  text += node("view", f.view, "{}", true, f.update_every);
  text += node("update", f.update, f.update_params, true, f.update_every);
  if (f.clones) text += node("keep", "sink.bench", "{}", false);
  return text;
}

double faces_of(const ParticleSet& belief) {
  double faces = 0;
  for (const auto& map : belief.map) faces += static_cast<double>(map->stats().faces);
  return faces;
}

double mean_of(const Metrics& metrics, const std::string& column) {
  const auto found = metrics.columns().find(column);
  if (found == metrics.columns().end()) return 0;
  double sum = 0;
  for (const auto& row : found->second) sum += row.value;
  return sum / static_cast<double>(found->second.size());
}

}  // namespace

BenchTimes run_filter(const Registry& registry, BenchWorld& world, const BenchFilter& filter,
                      const std::vector<std::string>& nodes) {
  Registry with_bench = registry;
  add_bench_modules(with_bench, world);
  Graph graph = Graph::build(parse_yaml(graph_of(filter), "the graph of a benchmark"), with_bench);
  const Workers workers(filter.threads);
  Log log(LogLevel::error);
  Metrics metrics;
  Context context(workers, log, metrics, graph.seed(), {});
  Executor executor(graph, context);
  const auto turn = static_cast<std::int64_t>(world.frames.size());
  double cpu_s = 0, faces = 0;
  executor.on_frame = [&](std::int64_t done, std::int64_t) {
    if (done != 1 + turn) return;
    faces = faces_of(executor.belief());
    cpu_s = process_cpu_s();
  };
  const std::atomic<bool> stop{false};
  const RunSummary summary = executor.run(1 + kTurns * turn, stop);

  BenchTimes times;
  times.cpu_s = process_cpu_s() - cpu_s;
  times.frames = static_cast<int>((kTurns - 1) * turn);
  const double updates = static_cast<double>(times.frames) * filter.particles;
  times.faces_added = (faces_of(executor.belief()) - faces) / updates;
  if (filter.ess_below > 0) times.ancestors = mean_of(metrics, "pick.ancestors") / filter.particles;
  for (const Node& n : graph.nodes()) {
    if (std::ranges::find(nodes, n.name) == nodes.end()) continue;
    const auto& ms = summary.nodes.at(n.name).ms;  // of the frames in which it ran
    std::size_t runs = 0;
    for (std::int64_t frame = 1 + turn; frame <= kTurns * turn; ++frame) runs += n.gate.open(frame);
    for (std::size_t i = ms.size() - runs; i < ms.size(); ++i) times.wall_s += 1e-3 * ms[i];
  }
  return times;
}

}  // namespace ppm
