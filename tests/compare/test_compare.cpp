#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "tests/compare/suite_files.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// Two graphs, two seeds.
const char* const kTiny = R"(name: tiny
seeds: 2
memory: 100 MB
drop: [table]
comparisons:
  - name: c
    sequences: [{name: room, like: plain.yaml}]
    graphs:
      - {name: a, graph: room.yaml}
      - {name: b, graph: plain.yaml, sweep: {init.texel_size: [3 cm]}}
)";

struct Tiny : SuiteFiles {
  fs::path out = folder / "out";
  explicit Tiny(const std::string& text = kTiny) { write_text(suite_file(), text); }
  std::vector<std::string> arguments(std::vector<std::string> more) const {
    std::vector<std::string> all{"compare", suite_file(), "--out", out.string(), "--jobs", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::unique_ptr<Process> run(std::vector<std::string> more = {}) const { return ppm_command(arguments(std::move(more))); }
  nlohmann::json job(const std::string& folder_name) const { return read_json(out / "runs/c/room" / folder_name / "job.json"); }
  std::string digest(const std::string& folder_name) const { return read_json(out / "runs/c/room" / folder_name / "run.json")["digest"]; }
};

}  // namespace

TEST_CASE("a suite runs, leaves a folder that tells all, and does not run again what is done") {
  const Tiny suite;
  auto run = suite.run();
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK_THAT(run->out, Contains("4 runs: 0 done before, 4 done now, 0 failed"));
  CHECK(lines(run->err).size() == 4);  // in a pipe: a line a run

  const auto plan = read_json(suite.out / "suite.json");
  CHECK(plan["name"] == "tiny");
  CHECK(plan["machine"]["cores"].get<int>() > 0);
  CHECK(plan["machine"]["memory_bytes"].get<double>() > 1e8);
  const auto& comparison = plan["comparisons"][0];
  CHECK(comparison["graphs"][1]["name"] == "b[init.texel_size=3 cm]");
  CHECK(comparison["graphs"][1]["sweep"]["init.texel_size"] == "3 cm");
  CHECK(comparison["subject"] == "a");
  CHECK(comparison["against"] == "b[init.texel_size=3 cm]");
  REQUIRE(comparison["jobs"].size() == 4);
  for (const auto& job : comparison["jobs"]) {
    const fs::path folder = suite.out / job["folder"].get<std::string>();
    for (const char* file : {"run.json", "times.csv", "graph.yaml", "log.txt"}) CHECK(fs::exists(folder / file));
    const auto state = read_json(folder / "job.json");
    CHECK(state["status"] == "done");
    CHECK(state["exit_code"] == 0);
    CHECK(state["wall_s"].get<double>() > 0);
    CHECK(state["cpu_s"].get<double>() > 0);
    CHECK(state["peak_rss_bytes"].get<double>() > 1e7);
    CHECK(state["seed"] == job["seed"]);
    CHECK(read_json(folder / "run.json")["seed"] == job["seed"]);
    CHECK(state["command"] == job["command"]);
  }

  const auto report = content(suite.out / "report.json");
  CHECK(read_json(suite.out / "report.json")["comparisons"][0]["results"][0]["runs"]["done"] == 2);
  for (const char* file : {"report.html", "report.json", "report.md", "runs.csv"}) fs::remove(suite.out / file);
  CHECK_THAT(suite.run({"--report-only"})->out, Contains("report.html"));
  CHECK(content(suite.out / "report.json") == report);
  for (const char* file : {"report.html", "report.md", "runs.csv"}) CHECK(fs::exists(suite.out / file));

  run = suite.run();
  CHECK(run->code == 0);
  CHECK_THAT(run->out, Contains("4 done before, 0 done now"));
  CHECK(run->err.empty());
  run = suite.run({"--force", "--only", "c/room/a/2"});
  CHECK_THAT(run->out, Contains("1 runs: 0 done before, 1 done now"));
  CHECK_THAT(suite.run({"--dry-run"})->out, Contains("4 runs, 0 to be run"));
  CHECK(suite.run({"--only", "d"})->code == 2);
}

TEST_CASE("what changed is run again: a value, a seed, a run that failed or never ended") {
  const Tiny suite;
  REQUIRE(suite.run()->code == 0);
  const auto before = suite.digest("b_init.texel_size=3_cm/seed_1");
  std::string text = kTiny;
  text.replace(text.find("3 cm"), 4, "4 cm");
  text.replace(text.find("seeds: 2"), 8, "seeds: 3");
  write_text(suite.suite_file(), text);
  auto job = suite.job("a/seed_1");
  job["status"] = "running";  // as a machine that was switched off leaves it
  write_text(suite.out / "runs/c/room/a/seed_1/job.json", job.dump());
  job["status"] = "failed";
  job["exit_code"] = 1;
  write_text(suite.out / "runs/c/room/a/seed_2/job.json", "half of");
  const auto list = suite.run({"--dry-run"});
  CHECK_THAT(list->out, Contains("c/room/a/1  begun, not finished") && Contains("c/room/a/2  not run") && Contains("6 runs, 6 to be run"));
  CHECK_THAT(suite.run()->out, Contains("0 done before, 6 done now"));
  CHECK(suite.digest("b_init.texel_size=4_cm/seed_1") != before);
}

TEST_CASE("a run that fails does not end the suite") {
  const Tiny suite(R"(name: tiny
memory: 100 MB
comparisons:
  - name: c
    sequences:
      - {name: gone, nodes: [{name: camera, module: source.seven_scenes, params: {path: /no/such/folder}}]}
      - {name: room, like: plain.yaml}
    graphs: [{name: a, graph: plain.yaml}]
)");
  const auto run = suite.run();
  CHECK(run->code == 1);
  CHECK_THAT(run->out, Contains("1 done now, 1 failed"));
  CHECK_THAT(run->err, Contains("failed: c/gone/a/1") && Contains("/no/such/folder"));
  const auto job = read_json(suite.out / "runs/c/gone/a/seed_1/job.json");
  CHECK(job["status"] == "failed");
  CHECK(job["exit_code"] == 2);
  CHECK_THAT(job["error"].get<std::string>(), Contains("exit code 2") && Contains("/no/such/folder"));
  CHECK(suite.job("a/seed_1")["status"] == "done");
}

namespace {

/// Runs that take minutes, where nobody ends them.
const char* const kLong = R"(name: tiny
memory: 100 MB
comparisons:
  - name: c
    sequences: [{name: room, nodes: [{name: camera, module: source.synthetic_room, params: {frames: 20000}}]}]
    graphs: [{name: a, graph: plain.yaml}, {name: b, graph: plain.yaml}]
)";

void wait_for(const fs::path& file) {
  for (int i = 0; i < 400 && !fs::exists(file); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(25));
}

}  // namespace

TEST_CASE("a run that takes too long is ended and has failed") {
  const Tiny suite(std::string(kLong) + "time_limit: 1 s\n");
  const auto run = suite.run({"--only", "c/room/a"});
  CHECK(run->code == 1);
  CHECK_THAT(suite.job("a/seed_1")["error"].get<std::string>(), Contains("took longer than its time limit of 1 s"));
  CHECK(suite.job("a/seed_1")["exit_code"] == 128 + 9);
}

TEST_CASE("Ctrl-C ends the runs, which count as not run") {
  const Tiny suite(kLong);
  auto run = start_ppm(suite.arguments({}));
  wait_for(suite.out / "runs/c/room/b/seed_1/job.json");
  run->send(SIGINT);
  run->wait();
  CHECK(run->code == 1);
  CHECK_THAT(run->out, Contains("interrupted"));
  CHECK_THAT(suite.run({"--dry-run"})->out, Contains("c/room/a/1  not run") && Contains("c/room/b/1  not run"));
}

TEST_CASE("a killed ppm compare: its runs hold the folder until they end, then the suite goes on") {
  const Tiny suite(R"(name: tiny
memory: 100 MB
comparisons:
  - name: c
    sequences: [{name: room, like: plain.yaml, set: {eye.frames: 60}}]
    graphs: [{name: a, graph: plain.yaml}, {name: b, graph: plain.yaml}]
)");
  auto killed = start_ppm(suite.arguments({}));
  wait_for(suite.out / "runs/c/room/b/seed_1/job.json");
  killed->send(SIGKILL);
  killed->wait();
  CHECK(killed->signal == SIGKILL);
  auto again = suite.run();
  for (int i = 0; i < 200 && again->code == 1; ++i) {
    CHECK_THAT(again->err, Contains("another ppm compare is at work in this folder, or runs that it left are"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    again = suite.run();
  }
  CHECK(again->code == 0);
  CHECK(suite.job("a/seed_1")["status"] == "done");
  CHECK(suite.job("b/seed_1")["status"] == "done");
}

TEST_CASE("a folder that holds other things, another suite, or is a file") {
  const Tiny suite;
  fs::create_directory(suite.out);
  write_text(suite.out / "thesis.tex", "years of work");
  auto refused = suite.run();
  CHECK(refused->code == 2);
  CHECK_THAT(refused->err, Contains("the folder holds other things than a suite"));
  fs::remove(suite.out / "thesis.tex");
  write_text(suite.out / "suite.json", R"({"name": "other"})");
  refused = suite.run();
  CHECK(refused->code == 2);
  CHECK_THAT(refused->err, Contains("the folder holds the suite 'other', this is 'tiny'"));
  CHECK(suite.run({"--memory", "2 m"})->code == 2);
}
