#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "apps/accuracy.hpp"
#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "apps/run_report.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/maps/ppm/ppm_file.hpp"

namespace ppm {

namespace {

void print(const Accuracy& accuracy, bool json) {
  fmt::print("{}", json ? accuracy_json(accuracy) : accuracy_table(accuracy));
}

struct TrajectoryOptions {
  std::filesystem::path estimated, reference;
  double max_dt_s = 0.02;
  int delta = 1;
  bool json = false;
};

void evaluate_trajectory(const TrajectoryOptions& o) {
  Accuracy accuracy;
  accuracy.trajectory = trajectory_error(read_tum(o.estimated), read_tum(o.reference), o.max_dt_s, o.delta);
  print(accuracy, o.json);
}

void add_trajectory(CLI::App& evaluate) {
  auto* command = evaluate.add_subcommand("trajectory", "A path against a reference, both in TUM format: ATE and RPE");
  auto o = std::make_shared<TrajectoryOptions>();
  command->add_option("estimated", o->estimated, "Estimated path")->required()->type_name("FILE");
  command->add_option("reference", o->reference, "Reference path")->required()->type_name("FILE");
  command->add_option("--max-dt", o->max_dt_s, "Poses further apart in time are not compared, s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--delta", o->delta, "Poses between the two ends of a relative pose")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_flag("--json", o->json, "As JSON");
  command->callback([o] { evaluate_trajectory(*o); });
}

struct MapOptions {
  std::filesystem::path run;
  bool holdout = false, json = false;
  HoldoutFrom poses = HoldoutFrom::both;
  std::vector<std::filesystem::path> plugins;
  int threads = 0;
};

void evaluate_map(const MapOptions& o) {
  if (!o.holdout) throw ConfigError({}, "say what to measure the map with: --holdout");
  GraphOptions options;
  options.file = o.run / "config.effective.yaml";
  options.plugins = o.plugins;
  const Graph graph = options.load();
  auto* source = graph.first<FrameSource>();
  if (!source) throw ConfigError(Place{options.file.string()}, "the graph has no source to take held-out frames from");
  const auto last_index = last_index_of_run(o.run);
  const auto path = read_tum(o.run / "trajectory.tum");
  const auto file = o.run / "map.ppm";
  if (!std::filesystem::exists(file))
    throw ConfigError(Place{o.run.string()},
                      "holds no map.ppm (sink.map_ppm), which this command reads; maps of other kinds are measured by the run "
                      "itself: run.json, holdout.csv");
  const auto map = load_ppm(file);
  source->open_for_evaluation();
  const Accuracy accuracy = measure_accuracy(graph, path, last_index, map.get(), o.poses, Workers(o.threads));
  if (!accuracy.holdout && !accuracy.holdout_estimated)
    throw ConfigError(Place{options.file.string()},
                      "the graph holds out no frame that has a pose, or cannot predict views of this map");
  print(accuracy, o.json);
}

void add_map(CLI::App& evaluate) {
  auto* command = evaluate.add_subcommand("map", "The map of a run against frames that it has not seen");
  auto o = std::make_shared<MapOptions>();
  command
      ->add_option("run", o->run,
                   "Folder of a run, with map.ppm (sink.map_ppm) and trajectory.tum (sink.trajectory_tum)")
      ->required()
      ->type_name("FOLDER");
  command->add_flag("--holdout", o->holdout, "Predict the depth of the frames that the source held out");
  command
      ->add_option("--poses", o->poses,
                   "Where held-out frames are looked at from: 'reference' poses, or 'estimated' ones, the path's own "
                   "where it followed these frames, else between its neighbouring poses; by default both")
      ->transform(CLI::CheckedTransformer(std::map<std::string, HoldoutFrom>{{"reference", HoldoutFrom::reference},
                                                                             {"estimated", HoldoutFrom::estimated}}));
  command->add_option("--threads", o->threads, "Worker threads; 0 is as many as the machine has")
      ->check(CLI::Range(0, 4096));
  add_plugin_option(*command, o->plugins);
  command->add_flag("--json", o->json, "As JSON");
  command->callback([o] { evaluate_map(*o); });
}

struct RevisitOptions {
  std::filesystem::path run;
  RevisitSettings settings;
  std::optional<std::int64_t> gap;
  bool reference = false, json = false;
  std::vector<std::filesystem::path> plugins;
  int threads = 0;
};

void evaluate_revisits(const RevisitOptions& o) {
  RevisitSettings settings = o.settings;
  if (o.gap) {
    settings.form = RevisitSettings::Gap::exactly;
    settings.gap = *o.gap;
  }
  auto path = read_tum(o.run / "trajectory.tum");
  GraphOptions options;
  options.file = o.run / "config.effective.yaml";
  options.plugins = o.plugins;
  const Graph graph = options.load();
  auto* source = graph.first<FrameSource>();
  if (!source) throw ConfigError(Place{options.file.string()}, "the graph has no source to take images from");
  source->open_for_evaluation();
  if (o.reference) path = source->reference(last_index_of_run(o.run));
  const auto error = score_revisits(path, *source, settings, Workers(o.threads));
  if (!error)
    throw ConfigError(Place{o.run.string()}, fmt::format("no place was seen from two images that are {}{} apart",
                                                         o.gap ? "" : "at least ", settings.gap));
  fmt::print("{}", o.json ? revisits_json(*error, settings) : revisits_line(*error, settings));
}

void add_revisits(CLI::App& evaluate) {
  auto* command = evaluate.add_subcommand(
      "revisits", "The path of a run against itself: how well images of one place agree. Needs no reference");
  auto o = std::make_shared<RevisitOptions>();
  command->add_option("run", o->run, "Folder of a run, with trajectory.tum (sink.trajectory_tum)")
      ->required()
      ->type_name("FOLDER");
  auto* least = command
                    ->add_option("--least", o->settings.gap,
                                 "Images that see the same place and are at least so many images of the source apart")
                    ->check(CLI::PositiveNumber)
                    ->capture_default_str();
  command->add_option("--gap", o->gap, "Images that are exactly so many apart, instead")
      ->check(CLI::PositiveNumber)
      ->excludes(least);
  command->add_option("--pairs", o->settings.pairs, "At most so many pairs")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_flag("--reference", o->reference, "With the source's reference poses in place of the run's");
  command->add_option("--threads", o->threads, "Worker threads; 0 is as many as the machine has")
      ->check(CLI::Range(0, 4096));
  add_plugin_option(*command, o->plugins);
  command->add_flag("--json", o->json, "As JSON");
  command->callback([o] { evaluate_revisits(*o); });
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto* command = app.add_subcommand("evaluate", "Measures a path or a map");
  command->require_subcommand(1);
  add_trajectory(*command);
  add_map(*command);
  add_revisits(*command);
}

}  // namespace ppm
