#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/compare/clock_text.hpp"
#include "apps/compare/job_choice.hpp"
#include "apps/compare/machine.hpp"
#include "apps/compare/plan_file.hpp"
#include "apps/compare/run_jobs.hpp"
#include "apps/compare/slurm_export.hpp"
#include "apps/compare/suite_folder.hpp"
#include "apps/report/report.hpp"
#include "apps/stop_signal.hpp"
#include "framework/config/units.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

struct CompareOptions {
  std::filesystem::path suite, out;
  std::vector<std::string> only;
  std::string memory;
  int jobs = 0;
  std::optional<int> job;
  bool force = false, any_build = false, dry_run = false, slurm = false, report_only = false;
};

/// A suite with its folder, and what of it is to be run.
struct Work {
  Plan plan;
  std::filesystem::path folder;
  std::string build;
  std::vector<Job> chosen;  ///< by --only
  std::vector<Job> due;     ///< those of them that are to be run
};

std::filesystem::path folder_of(const CompareOptions& options) {
  if (!options.out.empty()) return options.out;
  if (options.suite.empty()) throw ConfigError({}, "name a suite file, or with --out the folder of a suite");
  return std::filesystem::path("runs") / read_suite(options.suite).name;
}

Work prepare(const CompareOptions& options) {
  if (options.suite.empty()) throw ConfigError({}, "name a suite file");
  Work work{make_plan(read_suite(options.suite)), folder_of(options), build_digest(), {}, {}};
  auto is_chosen = [&](const Job& job) {
    return options.only.empty() || std::ranges::any_of(options.only, [&](const auto& pattern) { return is_meant(job, pattern); });
  };
  for (const auto& [job, graph] : work.plan.jobs) {
    if (!is_chosen(job)) continue;
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

/// What is due, with what is known of the jobs that ran before.
Schedule schedule_of(const CompareOptions& options, const Work& work) {
  Schedule schedule(in_order_of_seeds(work.due), limits_of(options));
  for (const auto& [job, graph] : work.plan.jobs) {
    const auto state = read_job_state(work.folder / job.folder);
    if (is_done(state, job, "")) schedule.measured(job, state->wall_s, state->peak_rss_bytes);
  }
  return schedule;
}

std::string standing(const std::optional<JobState>& state, bool due) {
  if (!state) return "not run";
  if (state->status == JobState::Status::running) return "begun, not finished";
  if (state->status == JobState::Status::failed) return "failed";
  return due ? "done, but to be run again" : "done";
}

void list(const CompareOptions& options, const Work& work) {
  auto due = work.due.begin();
  for (const auto& job : work.chosen) {
    const bool is_due = due != work.due.end() && due->id == job.id;
    if (is_due) ++due;
    fmt::print("{:4}  {}  {}\n", job.id, job.name(), standing(read_job_state(work.folder / job.folder), is_due));
  }
  const auto seconds = schedule_of(options, work).seconds_left({});
  fmt::print("{} runs, {} to be run{}\n", work.chosen.size(), work.due.size(),
             seconds && !work.due.empty() ? fmt::format(", about {}", clock_text(*seconds)) : "");
}

void warn_of_left_out(const Work& work, Log& log) {
  for (const auto& l : work.plan.left_out) log.warning("{}/{} is left out: {}", l.comparison, l.graph, l.reason);
}

void tell_failures(const JobRunner::Outcome& outcome, const std::filesystem::path& folder) {
  for (const auto& f : outcome.failures)
    fmt::print(stderr, "failed: {} ({})\n{}\n", f.job.name(), (folder / f.job.folder).string(), f.error);
}

void make_report(const std::filesystem::path& folder) {
  write_report(folder);
  fmt::print("report: {}\n", (folder / "report.html").string());
}

/// Runs what is due and makes the report. True where all went well.
bool run_suite(const CompareOptions& options) {
  const Work work = prepare(options);
  const auto program = this_program();
  make_suite_folder(work.folder, work.plan.suite);
  const SuiteLock lock(work.folder, SuiteLock::Kind::alone);
  Schedule schedule = schedule_of(options, work);
  write_plan(work.folder, work.plan, program);
  std::map<int, std::string> graphs;
  for (const auto& [job, graph] : work.plan.jobs) graphs[job.id] = graph;
  Log log;
  warn_of_left_out(work, log);
  const StopSignal stop("ending the runs");
  const auto outcome = JobRunner(work.folder, program, work.build, log).run(schedule, graphs, stop.requested());
  fmt::print("{} runs: {} done before, {} done now, {} failed{}; results in {}\n", work.chosen.size(),
             work.chosen.size() - work.due.size(), outcome.done, outcome.failures.size(), outcome.interrupted ? ", interrupted" : "",
             work.folder.string());
  tell_failures(outcome, work.folder);
  if (!outcome.interrupted) make_report(work.folder);
  return outcome.failures.empty() && !outcome.interrupted;
}

/// Leaves all that the tasks of a job array need. Runs nothing.
void export_to_slurm(const CompareOptions& options) {
  const Work work = prepare(options);
  make_suite_folder(work.folder, work.plan.suite);
  const SuiteLock lock(work.folder, SuiteLock::Kind::alone);
  const auto program = this_program();
  write_plan(work.folder, work.plan, program);
  for (const auto& [job, graph] : work.plan.jobs) {
    const auto folder = work.folder / job.folder;
    if (options.force || !is_done(read_job_state(folder), job, options.any_build ? "" : work.build)) prepare_job(folder, graph);
  }
  std::filesystem::create_directories(work.folder / "slurm");  // where the tasks' output goes
  const auto script = work.folder / "suite.sbatch";
  write_file(script, slurm_script(work.plan, work.folder, program));
  Log log;
  warn_of_left_out(work, log);
  fmt::print("{} runs, {} to be run:\n  sbatch {}\nand when they are done:\n  ppm compare --out {} --report-only\n", work.chosen.size(),
             work.due.size(), script.string(), work.folder.string());
}

/// Runs one job of a plan: a task of a job array. True where it went well.
bool run_job(const CompareOptions& options) {
  const auto folder = folder_of(options);
  const auto jobs = read_jobs(folder);
  const auto job = std::ranges::find(jobs, *options.job, &Job::id);
  if (job == jobs.end()) throw ConfigError(Place{fmt::format("--job {}", *options.job)}, fmt::format("the plan in {} has jobs 0 to {}", folder.string(), jobs.size() - 1));
  const SuiteLock lock(folder, SuiteLock::Kind::one_of_many);
  const auto build = build_digest();
  const auto state = read_job_state(folder / job->folder);
  if (!options.force && is_done(state, *job, options.any_build ? "" : build)) {
    fmt::print("{}: done before\n", job->name());
    return true;
  }
  const std::map<int, std::string> graphs{{job->id, read_experiment(folder / job->folder, *job)}};
  Schedule schedule({*job}, Limits{});
  Log log;
  const StopSignal stop("ending the run");
  const auto outcome = JobRunner(folder, this_program(), build, log).run(schedule, graphs, stop.requested());
  tell_failures(outcome, folder);
  return outcome.done == 1;
}

/// False where something failed.
bool compare(const CompareOptions& options) {
  if (options.report_only) {
    make_report(folder_of(options));
    return true;
  }
  if (options.job) return run_job(options);
  if (options.slurm) {
    export_to_slurm(options);
    return true;
  }
  if (!options.dry_run) return run_suite(options);
  list(options, prepare(options));
  return true;
}

void add_choices(CLI::App& command, CompareOptions& options) {
  command.add_option("suite", options.suite, "Suite file (YAML); with --job and --report-only the plan in the folder is enough")
      ->type_name("FILE");
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
}

void add_modes(CLI::App& command, CompareOptions& options) {
  auto* dry_run = command.add_flag("--dry-run", options.dry_run, "Lists the runs and how they stand; runs nothing");
  auto* slurm = command.add_flag("--slurm", options.slurm, "Writes the plan and suite.sbatch, a Slurm job array; runs nothing");
  auto* job = command.add_option("--job", options.job, "Runs one job of the plan in the folder: a task of the job array")
                  ->check(CLI::NonNegativeNumber)
                  ->type_name("N");
  auto* report = command.add_flag("--report-only", options.report_only, "Makes the report of the runs that are in the folder; runs nothing");
  dry_run->excludes(slurm)->excludes(job)->excludes(report);
  slurm->excludes(job)->excludes(report)->excludes(command.get_option("--only"));
  job->excludes(report);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto* command = app.add_subcommand("compare", "Runs a suite, graphs on sequences for several seeds side by side, and reports");
  auto options = std::make_shared<CompareOptions>();
  add_choices(*command, *options);
  add_modes(*command, *options);
  command->footer(
      "A suite goes on where it stopped: what is done is not run again, unless graph, seed or ppm itself changed. A run that fails "
      "does not end the suite; the exit code is 1 then.");
  command->callback([options] {
    if (!compare(*options)) throw CLI::RuntimeError(1);
  });
}

}  // namespace ppm
