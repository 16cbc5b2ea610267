#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <optional>
#include <regex>

#include "apps/bench/bench_report.hpp"
#include "apps/bench/bench_run.hpp"
#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "framework/config/units.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

struct BenchOptions {
  std::string filter;
  std::filesystem::path json;
  bool quick = false, list = false;
  std::optional<int> rounds;
  int threads = 0;
  std::string texel_size = "4 cm";
  std::vector<std::filesystem::path> plugins;
};

std::regex filter_of(const BenchOptions& options) {
  try {
    return std::regex(options.filter);
  } catch (const std::regex_error& e) {
    throw ConfigError(Place{"--filter " + options.filter}, std::string("is no regular expression: ") + e.what());
  }
}

/// The cases whose name has a match of the filter.
std::vector<BenchCase> chosen(const BenchPlan& plan, const BenchOptions& options) {
  auto cases = cases_of(plan);
  const auto filter = filter_of(options);
  std::erase_if(cases, [&](const BenchCase& c) { return !std::regex_search(c.name(), filter); });
  if (cases.empty())
    throw ConfigError(Place{"--filter " + options.filter}, "matches no benchmark; `ppm bench --list` names them");
  return cases;
}

double texel_size_of(const BenchOptions& options) {
  double metres = 0;
  const Place place{"--texel-size " + options.texel_size};
  if (const auto wrong = parse_quantity(options.texel_size, "m", metres); !wrong.empty())
    throw ConfigError(place, wrong);
  if (!(metres >= 1e-3)) throw ConfigError(place, "must be 1 mm or more");
  return options.quick ? 0.1 : metres;
}

/// Its name as the system gives it; "unknown" where it gives none.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void bench(const BenchOptions& options) {
  const Registry registry = make_registry(options.plugins);
  BenchWorlds worlds(registry, texel_size_of(options));
  const int threads = Workers(options.threads).threads();
  const BenchPlan plan = options.quick ? quick_plan(registry, worlds, threads) : full_plan(registry, worlds, threads);
  const auto cases = chosen(plan, options);
  if (options.list) {
    for (const auto& c : cases) fmt::print("{}\n", c.name());
    return;
  }
  const int rounds = options.rounds.value_or(options.quick ? 1 : 3);
  std::optional<AtomicFile> file;  // opened first: nothing is measured for a folder that is not there
  if (!options.json.empty()) file.emplace(options.json);
  Log log;
  const auto results = run_cases(cases, rounds, options.quick ? 1e-3 : 0.1, log);
  const auto kernels = kernel_shares(plan, results);
  if (file) {
    file->write(bench_json({processor(), threads, rounds, options.quick, texel_size_of(options)}, results, kernels));
    file->commit();
  }
  fmt::print("{}", result_table(results));
  const auto ratios = ratio_table(results);
  if (!ratios.empty()) fmt::print("\n{}", ratios);
  if (!kernels.empty()) fmt::print("\n{}", kernel_table(kernels));
}

}  // namespace

void add_bench(CLI::App& app) {
  auto* command = app.add_subcommand("bench", "Times views, weights, map updates and whole frames on this machine");
  auto options = std::make_shared<BenchOptions>();
  command->add_option("--filter", options->filter, "Only benchmarks whose name has a match of this regular expression")
      ->type_name("REGEX");
  command->add_option("--json", options->json, "Also writes all numbers to this file")->type_name("FILE");
  command->add_flag("--quick", options->quick, "Small maps, few particles, one round: whether it works, not how fast");
  command->add_flag("--list", options->list, "Names the benchmarks and runs none");
  command->add_option("--rounds", options->rounds, "Times each benchmark so often and gives the median (default: 3)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  command
      ->add_option("--threads", options->threads,
                   "Most worker threads, where their number varies; 0 is as many as the machine has")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  command
      ->add_option("--texel-size", options->texel_size,
                   "Of the maps; 4 cm gives as many texels a face as maps of real rooms have (about ten)")
      ->capture_default_str()
      ->type_name("LENGTH");
  add_plugin_option(*command, options->plugins);
  command->footer("A back-end that this machine cannot run is left out, with the reason.");
  command->callback([options] { bench(*options); });
}

}  // namespace ppm
