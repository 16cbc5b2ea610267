#include "apps/compare/run_jobs.hpp"

#include <cstring>
#include <poll.h>
#include <signal.h>

#include "apps/compare/clock_text.hpp"
#include "apps/compare/plan_file.hpp"

namespace ppm {

namespace {

constexpr int kLogLines = 10;      // of a failed run, in job.json
constexpr int kInterval_ms = 500;  // between looks at the clock

/// Why a run failed; "" where it did not.
std::string failure(const ChildResult& result, const Job& job, bool too_long, const std::filesystem::path& folder) {
  std::string why;
  if (too_long) {
    why = fmt::format("took longer than its time limit of {:.0f} s", job.time_limit_s);
  } else if (result.signal != 0) {
    why = fmt::format("ended by signal {} ({})", result.signal, ::strsignal(result.signal));
    if (result.signal == SIGKILL) why += fmt::format(": out of memory? It had taken {:.0f} MB", result.peak_rss_bytes / 1e6);
  } else if (result.exit_code != 0) {
    why = fmt::format("exit code {}", result.exit_code);
  } else if (!std::filesystem::exists(folder / "run.json")) {
    why = "it left no run.json";
  } else {
    return "";
  }
  const auto lines = last_lines(folder / kJobLog, kLogLines);
  return lines.empty() ? why : why + "\n" + lines;
}

}  // namespace

JobRunner::Outcome JobRunner::run(Schedule& schedule, const std::map<int, std::string>& graphs, const std::atomic<bool>& stop) {
  Outcome outcome;
  while (!stop) {
    while (const auto job = schedule.start()) start(*job, graphs.at(job->id));
    if (running_.empty()) break;
    show(schedule, outcome);
    wait();
    if (!stop) collect(schedule, outcome);
  }
  outcome.interrupted = stop;
  end_all(schedule);
  log_.status("");
  return outcome;
}

void JobRunner::start(const Job& job, const std::string& graph_yaml) {
  const auto folder = folder_ / job.folder;
  prepare_job(folder, graph_yaml);
  JobState state;
  state.seed = job.seed;
  state.threads = job.threads;
  state.command = command_of(job, folder_, program_);
  state.experiment = job.experiment;
  state.build = build_;
  write_job_state(folder, state);
  running_.push_back({job, Child(state.command, folder / kJobLog), state});
}

/// Until a job ends, a signal comes, or it is time to look at the clock.
void JobRunner::wait() const {
  std::vector<pollfd> polls;
  for (const auto& r : running_) polls.push_back({r.child.descriptor(), POLLIN, 0});
  ::poll(polls.data(), polls.size(), kInterval_ms);
}

void JobRunner::collect(Schedule& schedule, Outcome& outcome) {
  for (auto running = running_.begin(); running != running_.end();) {
    if (const auto result = running->child.result()) {
      finish(*running, *result, schedule, outcome);
      running = running_.erase(running);
      continue;
    }
    if (running->child.seconds() > running->job.time_limit_s) {
      running->too_long = true;
      running->child.kill();
    }
    ++running;
  }
}

void JobRunner::finish(Running& running, const ChildResult& result, Schedule& schedule, Outcome& outcome) {
  JobState& state = running.state;
  const auto folder = folder_ / running.job.folder;
  state.exit_code = result.exit_code;
  state.wall_s = result.wall_s;
  state.cpu_s = result.cpu_s;
  state.peak_rss_bytes = result.peak_rss_bytes;
  state.error = failure(result, running.job, running.too_long, folder);
  state.status = state.error.empty() ? JobState::Status::done : JobState::Status::failed;
  write_job_state(folder, state);
  schedule.ended(running.job);
  if (state.error.empty()) {
    ++outcome.done;
    schedule.measured(running.job, result.wall_s, result.peak_rss_bytes);
    log_.info("{}: done in {:.1f} s, {:.0f} MB", running.job.name(), result.wall_s, result.peak_rss_bytes / 1e6);
  } else {
    outcome.failures.push_back({running.job, state.error});
    log_.error("{}: {}", running.job.name(), state.error.substr(0, state.error.find('\n')));
  }
}

/// Jobs that were ended before their time have not run.
void JobRunner::end_all(Schedule& schedule) {
  for (const auto& r : running_) r.child.kill();
  for (const auto& r : running_) schedule.ended(r.job);
  std::vector<std::filesystem::path> folders;
  for (const auto& r : running_) folders.push_back(folder_ / r.job.folder);
  running_.clear();  // waits for the processes
  for (const auto& folder : folders) remove_job_state(folder);
}

void JobRunner::show(const Schedule& schedule, const Outcome& outcome) {
  std::map<int, double> seconds;
  for (const auto& r : running_) seconds[r.job.id] = r.child.seconds();
  const auto left = schedule.seconds_left(seconds);
  const auto all = static_cast<std::size_t>(outcome.done) + outcome.failures.size() + schedule.waiting() + schedule.running();
  log_.status(fmt::format("{} of {} runs done, {} running, {} failed{}", outcome.done, all, schedule.running(), outcome.failures.size(),
                          left ? fmt::format(", {} left", clock_text(*left)) : ""));
}

}  // namespace ppm
