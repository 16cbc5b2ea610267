// A run that goes on from what Executor::save wrote gives what the run gives that was never stopped.
#include <catch2/catch.hpp>

#include "framework/slam/belief_digest.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::string_view kMagic = "PPMTEST\n";

const std::string kFilter =
    "name: toy\n"
    "seed: 5\n"
    "nodes:\n"
    "  - {name: camera, module: source.toy, params: {count: 6}}\n"
    "  - {name: init, module: map.toy, when: {until_frame: 0}, params: {particles: 37}}\n"
    "  - {name: walk, module: motion.toy_walk, in: {number: camera.number}, when: {from_frame: 1}}\n"
    "  - {name: look, module: prediction.toy, in: {number: camera.number}}\n"
    "  - {name: weigh, module: weighting.toy}\n"
    "  - {name: pick, module: resampling.toy, when: {every: 2}}\n"
    "  - {name: drift, module: refinement.toy_wind}\n"
    "  - {name: sum, module: sink.toy_sum, in: {number: look.doubled}}\n"
    "  - {name: last, module: sink.toy, in: {number: look.doubled}, when: {at_end: true}}\n";

struct Outcome {
  std::string digest, metrics;
  std::vector<std::string> end;  ///< the last events: what the nodes at the end and close() told
  RunSummary summary;
};

Outcome finish(ToyRun& run) {
  Outcome o;
  events().clear();
  o.summary = run.run();
  o.digest = belief_digest(run.executor.belief(), run.workers);
  o.metrics = run.metrics.to_csv();
  for (const auto& e : events())
    if ((e.starts_with("last.") || e.starts_with("sum.")) && e != "last.open 0") o.end.push_back(e);
  return o;
}

/// Runs a graph until `frames` are done and writes its state.
void save_after(const std::string& graph, std::int64_t frames, const std::filesystem::path& file) {
  ToyRun run(graph);
  run.executor.on_frame = [&](auto done, auto) {
    if (done != frames) return;
    RecordFileWriter out(file, kMagic);
    run.executor.save(out);
    out.commit();
  };
  run.run(frames);
}

Outcome go_on(const std::string& graph, const std::filesystem::path& file, int threads = 1) {
  ToyRun run(graph, threads);
  RecordFileReader in(file, kMagic, "a checkpoint");
  run.executor.load(in);
  in.finish("the belief");
  return finish(run);
}

}  // namespace

TEST_CASE("a run that goes on from any frame ends as the one that never stopped, with any number of threads") {
  TempFolder folder;
  ToyRun whole(kFilter);
  const auto expected = finish(whole);
  for (std::int64_t frames = 1; frames <= 6; ++frames) {
    INFO(frames);
    save_after(kFilter, frames, folder / "state");
    const auto resumed = go_on(kFilter, folder / "state", frames % 2 ? 1 : 3);
    CHECK(resumed.digest == expected.digest);
    CHECK(resumed.metrics == expected.metrics);
    CHECK(resumed.summary.frames == 6);
    CHECK(resumed.summary.resumed == std::vector<std::int64_t>{frames});
    CHECK(resumed.summary.nodes.at("walk").ms.size() == expected.summary.nodes.at("walk").ms.size());
    CHECK(resumed.summary.wall_s > 0);
    // Frame 5, the last, has the number 5: the node at the end sees twice that, also where nothing was left to run.
    CHECK(resumed.end == expected.end);
    CHECK(expected.end == std::vector<std::string>{"last.got 10 in 5", "sum.total 30 5", "last.close 5"});
  }
}

TEST_CASE("a run may be stopped and go on more than once") {
  TempFolder folder;
  ToyRun whole(kFilter);
  const auto expected = finish(whole);
  save_after(kFilter, 2, folder / "first");
  {
    ToyRun run(kFilter);
    RecordFileReader in(folder / "first", kMagic, "a checkpoint");
    run.executor.load(in);
    run.executor.on_frame = [&](auto done, auto) { run.stop = done == 4; };
    run.executor.on_stop = [&] {
      RecordFileWriter out(folder / "second", kMagic);
      run.executor.save(out);
      out.commit();
    };
    CHECK(run.run().interrupted);
  }
  const auto resumed = go_on(kFilter, folder / "second");
  CHECK(resumed.digest == expected.digest);
  CHECK(resumed.summary.resumed == std::vector<std::int64_t>{2, 4});
}

TEST_CASE("on_stop comes before the nodes at the end, and not where no frame was done") {
  ToyRun run(kFilter);
  std::size_t before = 0;
  run.executor.on_frame = [&](auto done, auto) { run.stop = done == 2; };
  run.executor.on_stop = [&] { before = events().size(); };
  run.run();
  REQUIRE(before > 0);
  CHECK(events()[before] == "last.got 2 in 1");

  ToyRun none(kFilter);
  none.stop = true;
  none.executor.on_stop = [] { FAIL("nothing was done"); };
  CHECK(none.run().frames == 0);
}

TEST_CASE("a state of another graph is refused, with the node") {
  TempFolder folder;
  save_after(kFilter, 3, folder / "state");
  auto without_sum = kFilter;
  without_sum.erase(without_sum.find("  - {name: sum"), without_sum.find("  - {name: last") - without_sum.find("  - {name: sum"));
  CHECK_THROWS_WITH(go_on(without_sum, folder / "state"),
                    Contains("the state of node 'last' has bytes left over"));
}

TEST_CASE("maps that no module can save are told before the first frame") {
  try {
    ToyRun run("checkpoint_every: 2\n" + kFilter);
    FAIL("no error");
  } catch (const ConfigError& e) {
    CHECK(std::string(e.what()) ==
          "toy.yaml:1:19: checkpoints cannot keep the maps of node 'init': no module says how maps of kind 'toy' are saved");
  }
}

TEST_CASE("the interval of checkpoints is part of the effective graph, and not of the experiment") {
  const std::string text = "name: toy\ncheckpoint_every: 20\nnodes:\n  - {name: camera, module: source.toy}\n";
  const auto graph = Graph::build(parse_yaml(text, "toy.yaml"), ToyRun::registry());
  CHECK(graph.checkpoint_every() == 20);
  CHECK_THAT(graph.effective_yaml(), Contains("checkpoint_every: 20"));
  CHECK_THAT(graph.experiment_yaml(), !Contains("checkpoint_every"));
  const auto again = Graph::build(parse_yaml(graph.effective_yaml(), "again.yaml"), ToyRun::registry());
  CHECK(again.effective_yaml() == graph.effective_yaml());
  CHECK_THROWS_WITH(Graph::build(parse_yaml("name: toy\ncheckpoint_every: -1\nnodes: []\n", "toy.yaml"), ToyRun::registry()),
                    Contains("toy.yaml:2:19") && Contains("at least 0"));
}
