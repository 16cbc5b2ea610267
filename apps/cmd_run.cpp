#include <CLI/CLI.hpp>
#include <exception>
#include <fmt/core.h>
#include <limits>
#include <memory>

#include "apps/accuracy.hpp"
#include "apps/checkpoint.hpp"
#include "apps/commands.hpp"
#include "apps/error_tables.hpp"
#include "apps/frame_times.hpp"
#include "apps/graph_options.hpp"
#include "apps/progress.hpp"
#include "apps/run_folder.hpp"
#include "apps/run_report.hpp"
#include "apps/run_views.hpp"
#include "apps/stop_signal.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

struct RunOptions {
  GraphOptions graph;
  std::filesystem::path out, resume;
  std::optional<std::int64_t> frames;
  int threads = 0;
  std::size_t views = 0;
  bool force = false, quiet = false, times = false;
};

/// What a run holds, in the order in which it is made.
struct Run {
  std::unique_ptr<Checkpoint> from;  // where it goes on, or null
  Graph graph;
  RunStart start;
  RunFolder folder;
  Workers workers;
  Log log;
  Metrics metrics;
  Context context;
  Executor executor;
  CheckpointCosts checkpoints;
  std::optional<FrameTimes> times;  // where they are asked for

  explicit Run(const RunOptions& options)
      : from(options.resume.empty() ? nullptr : std::make_unique<Checkpoint>(options.resume)),
        graph(options.graph.load()),
        start(from ? from->start() : RunStart{graph.experiment_yaml(), options.graph.file, kNoLimit, {}}),
        folder(from ? RunFolder(options.resume, start.files)
                    : RunFolder(options.out.empty() ? std::filesystem::path("runs") / graph.name() : options.out, options.force)),
        workers(options.threads),
        log(options.quiet ? LogLevel::warning : LogLevel::info),
        context(workers, log, metrics, graph.seed(), folder.path()),
        executor(graph, context) {
    if (options.frames) start.max_frames = *options.frames;
    if (from) from->check_graph(graph, options.graph.file);
  }

  RunSummary frames(bool quiet, bool keep_times) {
    StopSignal stop("finishing this frame and writing the results");
    if (from) {
      from->restore(executor);
      from.reset();
    }
    const auto before = executor.frames();
    Progress progress(log, before);
    if (keep_times) times.emplace();
    executor.on_frame = [&](std::int64_t done, std::int64_t expected) {
      if (done == before + 1) begin_folder();
      if (times) times->add(done - 1);
      if (graph.checkpoint_every() > 0 && done % graph.checkpoint_every() == 0) keep_checkpoint();
      if (!quiet) progress.show(done, expected);
    };
    executor.on_stop = [&] { keep_checkpoint(); };
    return executor.run(start.max_frames, stop.requested());
  }

  /// Measures path and map, and draws so many views of it.
  Accuracy accuracy(std::size_t views) const {
    const auto& belief = executor.belief();
    if (belief.size() == 0) return {};
    const auto best = belief.best();
    const auto path = belief.trajectory[best].poses();
    if (path.empty()) return {};
    const Map* map = belief.map[best].get();
    auto accuracy = measure_accuracy(graph, path, path.back().frame, map, HoldoutFrom::both, workers);
    measure_path(graph, path, workers, accuracy);
    if (views > 0) write_views(folder.path(), graph, path, path.back().frame, map, views, workers);
    return accuracy;
  }

  Tracking tracking() const { return tracking_of(graph, metrics); }

  void write(const RunSummary& summary, const Accuracy& measured) {
    write_file(folder.path() / kEffectiveGraph, graph.effective_yaml());
    write_table("times.csv", times ? times->csv() : "");
    write_table("trajectory_error.csv", trajectory_error_csv(measured));
    write_table("holdout.csv", holdout_csv(measured));
    const RunReport report{graph,    summary,  executor.belief(), metrics,          workers,
                           measured, tracking(), checkpoints, start.graph_file,  folder.written()};
    write_file(folder.path() / "run.json", run_json(report));
  }

  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

 private:
  void write_table(const char* name, const std::string& csv) const {
    if (!csv.empty()) write_file(folder.path() / name, csv);
  }

  /// The first frame is done: its input could be read, so an earlier run's results may go.
  void begin_folder() {
    folder.drop_earlier_results();
    write_file(folder.path() / kEffectiveGraph, graph.effective_yaml());
  }

  /// A checkpoint that cannot be written is no reason to lose the run: it is told, and the one before stays.
  void keep_checkpoint() {
    const Stopwatch watch;
    try {
      start.files = folder.written();
      checkpoints.bytes = write_checkpoint(folder.path() / kCheckpoint, start, executor);
      checkpoints.frame = executor.frames();
      checkpoints.ms.push_back(watch.ms());
    } catch (const Error& e) {
      log.error("no checkpoint after {} frames: {}", executor.frames(), e.what());
    }
  }
};

/// False where the run was interrupted.
bool run(const RunOptions& options) {
  Run run(options);
  const RunSummary summary = run.frames(options.quiet, options.times);
  Accuracy measured;
  std::exception_ptr broken;  // a held-out frame or a reference pose: the run itself is sound and is written
  try {
    measured = run.accuracy(options.views);
  } catch (const DataError&) {
    broken = std::current_exception();
  }
  run.write(summary, measured);
  if (broken) std::rethrow_exception(broken);
  if (!options.quiet) {
    const auto folder = run.folder.path().string();
    fmt::print("{} {} frames in {:.1f} s ({:.1f} fps); results in {}\n{}{}",
               summary.interrupted ? "interrupted after" : "done:", summary.frames, summary.wall_s,
               static_cast<double>(summary.frames) / std::max(summary.wall_s, 1e-9), folder, tracking_line(run.tracking()),
               accuracy_table(measured));
    if (summary.interrupted && run.checkpoints.frame > 0) fmt::print("to go on: ppm run --resume {}\n", folder);
  }
  return !summary.interrupted;
}

/// The graph of a run that goes on is that of its folder.
void find_graph(RunOptions& options) {
  if (!options.resume.empty()) options.graph.file = options.resume / kEffectiveGraph;
  if (options.graph.file.empty())
    throw ConfigError({}, "name a graph file, or with --resume the folder of a run that is to go on");
}

void add_options(CLI::App& command, RunOptions& options) {
  options.graph.add_to(command);
  command.get_option("graph")->required(false);
  command.add_option("--frames", options.frames, "At most so many frames, those before a --resume counted")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command
      .add_option("--threads", options.threads,
                  "Worker threads; 0 is as many as the machine has. The results do not depend on it")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  command.add_option("--out", options.out, "Folder for the results (default: runs/NAME, after the graph's name)")
      ->type_name("FOLDER");
  command.add_flag("--force", options.force, "Write also into a folder that holds other things than a run");
  command.add_flag("--quiet", options.quiet, "Only warnings and errors");
  command.add_flag("--times", options.times,
                   "Also writes times.csv: time and memory of the process, frame by frame (of this part of the run)");
  command
      .add_option("--views", options.views,
                  "Also draws so many of the held-out frames, evenly over the run: as measured, as the map predicts them, "
                  "and the error (folder views)")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  command
      .add_option("--checkpoint-every", options.graph.checkpoint_every,
                  "Keeps the state of the run each N frames, in place of the graph's checkpoint_every; 0 is never")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  auto* resume = command
                     .add_option("--resume", options.resume,
                                 "Goes on with the run of that folder from its last checkpoint, as if it had not "
                                 "stopped: graph, seed and plug-ins are the folder's")
                     ->type_name("FOLDER");
  for (const char* other : {"graph", "--set", "--seed", "--plugin", "--out", "--force"})
    resume->excludes(command.get_option(other));
}

}  // namespace

void add_run(CLI::App& app) {
  auto* command = app.add_subcommand("run", "Runs a graph and writes a folder of results, or goes on with a run");
  auto options = std::make_shared<RunOptions>();
  add_options(*command, *options);
  command->footer(
      "Ctrl-C ends the frame, writes everything and a checkpoint, and exits with 1; a second one aborts. A run that was "
      "stopped or killed goes on with --resume.");
  command->callback([options] {
    find_graph(*options);
    if (!run(*options)) throw CLI::RuntimeError(1);
  });
}

}  // namespace ppm
