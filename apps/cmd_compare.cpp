#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/compare/job_choice.hpp"
#include "apps/compare/machine.hpp"
#include "apps/compare/run_jobs.hpp"
#include "apps/compare/suite_folder.hpp"
#include "apps/graph_options.hpp"
#include "apps/report/report.hpp"
#include "apps/stop_signal.hpp"
#include "framework/config/units.hpp"

namespace ppm {

namespace {

struct CompareOptions {
  std::filesystem::path suite, out;
  std::vector<std::filesystem::path> plugins;
  std::vector<std::string> only;
  std::string memory;
  int jobs = 0;
  bool force = false, any_build = false, dry_run = false, report_only = false;
};

/// A suite with its folder, and what of it is to be run.
struct Work {
  Plan plan;
  std::filesystem::path folder;
  std::string build;
  std::vector<Job> chosen;  ///< by --only
  std::vector<Job> due;     ///< those of them that are to be run
};

bool is_chosen(const CompareOptions& options, const Job& job) {
  return options.only.empty() || std::ranges::any_of(options.only, [&](const auto& pattern) { return is_meant(job, pattern); });
}

std::filesystem::path folder_of(const CompareOptions& options, const Suite& suite) {
  return options.out.empty() ? std::filesystem::path("runs") / suite.name : options.out;
}

Work prepare(const CompareOptions& options) {
  Work work;
  work.plan = make_plan(read_suite(options.suite), options.plugins);
  work.folder = folder_of(options, work.plan.suite);
  work.build = build_digest();
  for (const auto& planned : work.plan.jobs) {
    const Job& job = planned.job;
    if (!is_chosen(options, job)) continue;
    work.chosen.push_back(job);
    const auto state = read_job_state(work.folder / job.folder);
    if (options.force || !is_done(state, job, options.any_build ? "" : work.build)) work.due.push_back(job);
  }
  for (const auto& pattern : options.only)
    if (std::ranges::none_of(work.chosen, [&](const Job& job) { return is_meant(job, pattern); }))
      throw ConfigError(Place{"--only " + pattern}, "no run of the suite is meant by that; --dry-run lists them");
  return work;
}

Limits limits_of(const CompareOptions& options) {
  Limits limits{this_machine().cores, options.jobs, static_cast<double>(free_memory())};
  if (options.memory.empty()) return limits;
  const auto wrong = parse_quantity(options.memory, "bytes", limits.memory_bytes);
  if (!wrong.empty()) throw ConfigError(Place{"--memory " + options.memory}, wrong);
  return limits;
}

std::string standing(const std::optional<JobState>& state, bool due) {
  if (!state) return "not run";
  if (state->status == JobState::Status::running) return "begun, not finished";
  if (state->status == JobState::Status::failed) return "failed";
  return due ? "done, but of another experiment or build" : "done";
}

void list(const Work& work) {
  std::size_t due = 0;
  for (const auto& job : work.chosen) {
    const bool is_due = due < work.due.size() && work.due[due].id == job.id;
    due += is_due;
    fmt::print("{:4}  {}  {}\n", job.id, job.name(), standing(read_job_state(work.folder / job.folder), is_due));
  }
  fmt::print("{} runs, {} to be run\n", work.chosen.size(), work.due.size());
}

void make_report(const std::filesystem::path& folder) {
  write_report(folder);
  fmt::print("report: {}\n", (folder / "report.html").string());
}

/// Runs what is due and reports. True where all went well.
bool run(const CompareOptions& options, const Work& work) {
  const auto program = this_program();
  make_suite_folder(work.folder, work.plan.suite);
  const SuiteLock lock(work.folder, SuiteLock::Kind::alone);
  write_plan(work.folder, work.plan, program);
  Schedule schedule(in_order_of_seeds(work.due), limits_of(options));
  std::map<int, std::string> graphs;
  for (const auto& planned : work.plan.jobs) {
    graphs[planned.job.id] = planned.graph_yaml;
    const auto state = read_job_state(work.folder / planned.job.folder);
    if (is_done(state, planned.job, "")) schedule.measured(planned.job, state->wall_s, state->peak_rss_bytes);
  }
  Log log;
  const StopSignal stop("ending the runs");
  const auto outcome = JobRunner(work.folder, program, work.build, log).run(schedule, graphs, stop.requested());
  fmt::print("{} runs: {} done before, {} done now, {} failed{}; results in {}\n", work.chosen.size(),
             work.chosen.size() - work.due.size(), outcome.done, outcome.failures.size(),
             outcome.interrupted ? ", interrupted" : "", work.folder.string());
  for (const auto& f : outcome.failures) fmt::print(stderr, "failed: {} ({})\n{}\n", f.job.name(), (work.folder / f.job.folder).string(), f.error);
  make_report(work.folder);
  return outcome.failures.empty() && !outcome.interrupted;
}

void add_options(CLI::App& command, CompareOptions& options) {
  command.add_option("suite", options.suite, "Suite file (YAML)")->required()->type_name("FILE");
  command.add_option("--out", options.out, "Folder for the results (default: runs/NAME, after the suite's name)")->type_name("FOLDER");
  command.add_option("--jobs", options.jobs, "Runs side by side (default: as many as the cores have room for)")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command.add_option("--memory", options.memory, "Memory that runs may take together, with its unit (default: what is free)")
      ->type_name("SIZE");
  command
      .add_option("--only", options.only,
                  "Runs a part: comparison/sequence/graph/seed, with * and ?; parts left out at the end mean all; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  command.add_flag("--force", options.force, "Runs again what is done");
  command.add_flag("--any-build", options.any_build, "What was done by another build of ppm counts as done");
  command.add_flag("--dry-run", options.dry_run, "Lists the runs and how they stand; runs nothing");
  command.add_flag("--report-only", options.report_only, "Runs nothing; makes the report of what lies in the folder");
  add_plugin_option(command, options.plugins);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto* command = app.add_subcommand("compare", "Runs a suite: graphs on sequences for several seeds, side by side");
  auto options = std::make_shared<CompareOptions>();
  add_options(*command, *options);
  command->footer(
      "A suite goes on where it stopped: what is done is not run again, unless graph, seed or ppm itself changed. A run that fails "
      "does not end the suite; the exit code is 1 then.");
  command->callback([options] {
    if (options->report_only) return make_report(folder_of(*options, read_suite(options->suite)));
    const Work work = prepare(*options);
    if (options->dry_run) {
      list(work);
    } else if (!run(*options, work)) {
      throw CLI::RuntimeError(1);
    }
  });
}

}  // namespace ppm
