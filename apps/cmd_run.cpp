#include <CLI/CLI.hpp>
#include <exception>
#include <fmt/core.h>
#include <limits>
#include <memory>

#include "apps/accuracy.hpp"
#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "apps/progress.hpp"
#include "apps/run_folder.hpp"
#include "apps/run_report.hpp"
#include "apps/stop_signal.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

struct RunOptions {
  GraphOptions graph;
  std::filesystem::path out;
  std::int64_t frames = std::numeric_limits<std::int64_t>::max();
  int threads = 0;
  bool force = false, quiet = false;
};

/// What a run holds, in the order in which it is made.
struct Run {
  Graph graph;
  RunFolder folder;
  Workers workers;
  Log log;
  Metrics metrics;
  Context context;
  Executor executor;

  explicit Run(const RunOptions& options)
      : graph(options.graph.load()),
        folder(options.out.empty() ? std::filesystem::path("runs") / graph.name() : options.out, options.force),
        workers(options.threads),
        log(options.quiet ? LogLevel::warning : LogLevel::info),
        context(workers, log, metrics, graph.seed(), folder.path()),
        executor(graph, context) {}

  RunSummary frames(const RunOptions& options) {
    StopSignal stop;
    Progress progress(log);
    executor.on_frame = [&](std::int64_t done, std::int64_t expected) {
      if (done == 1) folder.drop_earlier_results();
      if (!options.quiet) progress.show(done, expected);
    };
    return executor.run(options.frames, stop.requested());
  }

  Accuracy accuracy() const {
    const auto& belief = executor.belief();
    if (belief.size() == 0) return {};
    const auto best = belief.best();
    const auto path = belief.trajectory[best].poses();
    if (path.empty()) return {};
    return measure_accuracy(graph, path, path.back().frame, belief.map[best].get(), HoldoutFrom::automatic, workers);
  }

  void write(const RunSummary& summary, const Accuracy& measured, const std::filesystem::path& graph_file) {
    write_file(folder.path() / "config.effective.yaml", graph.effective_yaml());
    const RunReport report{graph, summary, executor.belief(), metrics, workers, measured, graph_file, folder.written()};
    write_file(folder.path() / "run.json", run_json(report));
  }
};

/// False where the run was interrupted.
bool run(const RunOptions& options) {
  Run run(options);
  const RunSummary summary = run.frames(options);
  Accuracy measured;
  std::exception_ptr broken;  // a held-out frame or a reference pose: the run itself is sound and is written
  try {
    measured = run.accuracy();
  } catch (const DataError&) {
    broken = std::current_exception();
  }
  run.write(summary, measured, options.graph.file);
  if (broken) std::rethrow_exception(broken);
  if (!options.quiet) {
    fmt::print("{} {} frames in {:.1f} s ({:.1f} fps); results in {}\n{}",
               summary.interrupted ? "interrupted after" : "done:", summary.frames, summary.wall_s,
               static_cast<double>(summary.frames) / std::max(summary.wall_s, 1e-9), run.folder.path().string(),
               accuracy_table(measured));
  }
  return !summary.interrupted;
}

}  // namespace

void add_run(CLI::App& app) {
  auto* command = app.add_subcommand("run", "Runs a graph and writes a folder of results");
  auto options = std::make_shared<RunOptions>();
  options->graph.add_to(*command);
  command->add_option("--frames", options->frames, "At most so many frames")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command
      ->add_option("--threads", options->threads,
                   "Worker threads; 0 is as many as the machine has. The results do not depend on it")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  command->add_option("--out", options->out, "Folder for the results (default: runs/NAME, after the graph's name)")
      ->type_name("FOLDER");
  command->add_flag("--force", options->force, "Write also into a folder that holds other things than a run");
  command->add_flag("--quiet", options->quiet, "Only warnings and errors");
  command->footer("Ctrl-C ends the frame, writes everything, and exits with 1; a second one aborts.");
  command->callback([options] {
    if (!run(*options)) throw CLI::RuntimeError(1);
  });
}

}  // namespace ppm
