#include <catch2/catch.hpp>

#include "apps/compare/slurm_export.hpp"
#include "tests/compare/suite_files.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kSuite = R"(name: tiny
seeds: 2
threads: 2
memory: 512 MiB
time_limit: 90 min
slurm: {at_once: 3, options: [--partition=long]}
comparisons:
  - name: c
    graphs: [{name: a, graph: plain.yaml, memory: 3 GiB}, {name: b, graph: room.yaml}]
)";

}  // namespace

TEST_CASE("the script of a job array asks for what the neediest run needs") {
  const SuiteFiles files;
  const auto script = slurm_script(files.plan(kSuite), "/data/my suite", "/opt/it's/ppm");
  for (const auto* line : {"#!/bin/bash\n", "#SBATCH --job-name=tiny\n", "#SBATCH --array=0-3%3\n", "#SBATCH --cpus-per-task=2\n", "#SBATCH --mem=3072M\n",
                           "#SBATCH --time=1:31:00\n", "#SBATCH --output=\"/data/my suite/slurm/%A_%a.txt\"\n", "#SBATCH --partition=long\n",
                           "for ((job = SLURM_ARRAY_TASK_ID; job < 4; job += 4)); do\n", "  '/opt/it'\\''s/ppm' compare --out '/data/my suite' --job \"$job\" || failed=1\n"})
    CHECK_THAT(script, Contains(line));
  CHECK_THAT(script, Contains("#SBATCH --chdir=\"" + fs::current_path().string() + "\"\n"));
}

TEST_CASE("more runs than a job array may have tasks: several a task") {
  const SuiteFiles files;
  auto plan = files.plan(kSuite);
  while (plan.jobs.size() < 2500) plan.jobs.push_back(plan.jobs[0]);
  const auto script = slurm_script(plan, "out", "ppm");
  CHECK_THAT(script, Contains("--array=0-999%3\n") && Contains("job < 2500; job += 1000)") && Contains("--time=4:31:00\n"));
}

TEST_CASE("an exported suite: its jobs run one by one from the plan in the folder, and are gathered") {
  const SuiteFiles files;
  write_text(files.suite_file(), kSuite);
  const auto out = (files.folder / "out").string();
  const auto exported = ppm_command({"compare", files.suite_file(), "--out", out, "--slurm"});
  INFO(exported->err);
  REQUIRE(exported->code == 0);
  CHECK_THAT(exported->out, Contains("4 runs, 4 to be run") && Contains("sbatch " + out + "/suite.sbatch"));
  CHECK(fs::exists(out + "/slurm"));
  fs::remove(files.suite_file());  // the plan is enough
  auto task = ppm_command({"compare", "--out", out, "--job", "2"});
  INFO(task->err);
  CHECK(task->code == 0);
  CHECK(read_json(out + "/runs/c/own/b/seed_1/job.json")["status"] == "done");
  CHECK_FALSE(fs::exists(out + "/runs/c/own/b/seed_2/job.json"));
  CHECK_THAT(ppm_command({"compare", "--out", out, "--job", "2"})->out, Contains("c/own/b/1: done before"));
  const auto report = ppm_command({"compare", "--out", out, "--report-only"});
  INFO(report->err);
  CHECK(report->code == 0);
  CHECK(fs::exists(out + "/report.html"));

  task = ppm_command({"compare", "--out", out, "--job", "4"});
  CHECK(task->code == 2);
  CHECK_THAT(task->err, Contains("has jobs 0 to 3"));
  write_text(out + "/runs/c/own/b/seed_2/graph.yaml", "name: another\n");
  task = ppm_command({"compare", "--out", out, "--job", "3"});
  CHECK(task->code == 2);
  CHECK_THAT(task->err, Contains("not the experiment of the plan"));
  CHECK(ppm_command({"compare", "--out", (files.folder / "none").string(), "--job", "0"})->code == 2);
  CHECK(ppm_command({"compare", "--job", "0"})->code == 2);
}
