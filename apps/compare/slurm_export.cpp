#include "apps/compare/slurm_export.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ppm {

namespace {

/// A word for the shell: in single quotes.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string time_text(double seconds) {
  const auto minutes = static_cast<long>(std::ceil(seconds / 60));
  return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

}  // namespace

std::string slurm_script(const Plan& plan, const std::filesystem::path& folder, const std::string& program) {
  const int runs = static_cast<int>(plan.jobs.size());
  const int tasks = std::min(runs, kMostTasks);
  const int runs_a_task = (runs + tasks - 1) / tasks;
  int threads = 1;
  double bytes = 0, seconds = 0;
  for (const auto& [job, graph] : plan.jobs) {
    threads = std::max(threads, job.threads);
    bytes = std::max(bytes, job.memory_bytes);
    seconds = std::max(seconds, job.time_limit_s);
  }
  const Suite& suite = plan.suite;
  std::string script = "#!/bin/bash\n";
  auto option = [&](const std::string& text) { script += "#SBATCH " + text + "\n"; };
  option("--job-name=" + suite.name);
  option(fmt::format("--array=0-{}{}", tasks - 1, suite.slurm_at_once > 0 ? fmt::format("%{}", suite.slurm_at_once) : ""));
  option(fmt::format("--cpus-per-task={}", threads));
  option(fmt::format("--mem={}M", static_cast<long>(std::ceil(bytes / (1024.0 * 1024)))));
  option("--time=" + time_text(seconds * runs_a_task + 60));  // the run ends itself first, and says so
  option(fmt::format("--chdir=\"{}\"", std::filesystem::current_path().string()));
  option(fmt::format("--output=\"{}/slurm/%A_%a.txt\"", folder.string()));
  for (const auto& text : suite.slurm_options) option(text);
  script += fmt::format("# Suite '{}': {} runs. Submit with: sbatch {}\n", suite.name, runs, (folder / "suite.sbatch").string());
  if (const char* data = std::getenv("PPM_DATA")) script += "export PPM_DATA=" + shell_word(data) + "\n";
  script += fmt::format("failed=0\nfor ((job = SLURM_ARRAY_TASK_ID; job < {}; job += {})); do\n", runs, tasks);
  script += fmt::format("  {} compare --out {} --job \"$job\" || failed=1\ndone\nexit $failed\n", shell_word(program), shell_word(folder.string()));
  return script;
}

}  // namespace ppm
