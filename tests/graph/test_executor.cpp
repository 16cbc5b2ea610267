#include <catch2/catch.hpp>

#include "framework/core/digest.hpp"
#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

using Events = std::vector<std::string>;

const std::string kSource = "name: toy\nnodes:\n  - {name: camera, module: source.toy}\n";

const std::string kFilter =
    "name: toy\n"
    "seed: 5\n"
    "nodes:\n"
    "  - {name: camera, module: source.toy, params: {count: 6}}\n"
    "  - {name: init, module: map.toy, when: {until_frame: 0}, params: {particles: 37}}\n"
    "  - {name: walk, module: motion.toy_walk, in: {number: camera.number}, when: {from_frame: 1}}\n"
    "  - {name: look, module: prediction.toy, in: {number: camera.number}}\n"
    "  - {name: weigh, module: weighting.toy}\n"
    "  - {name: pick, module: resampling.toy, when: {every: 2}}\n";

std::string digest_of(int threads) {
  ToyRun run(kFilter, threads);
  run.run();
  Digest digest;
  const auto& belief = run.executor.belief();
  digest.add(belief.log_weight);
  for (const auto& trajectory : belief.trajectory) {
    for (const auto& pose : trajectory.poses()) digest.add(pose.T_map_camera.translation().x());
  }
  return digest.hex();
}

}  // namespace

TEST_CASE("nodes open, tick and close in the order of the file, until the stream ends") {
  ToyRun run(kSource + "  - {name: out, module: sink.toy, in: {number: camera.number}}\n");
  auto summary = run.run();
  CHECK(summary.frames == 3);
  CHECK_FALSE(summary.interrupted);
  CHECK(summary.nodes.at("out").ms.size() == 3);
  CHECK(events() == Events{"camera.open 0", "out.open 0", "camera.tick 0", "out.got 0 in 0", "camera.tick 1",
                           "out.got 1 in 1", "camera.tick 2", "out.got 2 in 2", "camera.close 2", "out.close 2"});
}

TEST_CASE("a run ends after max_frames") {
  ToyRun run(kSource);
  std::vector<std::pair<std::int64_t, std::int64_t>> progress;
  run.executor.on_frame = [&](auto done, auto expected) { progress.emplace_back(done, expected); };
  CHECK(run.run(2).frames == 2);
  CHECK(progress == std::vector<std::pair<std::int64_t, std::int64_t>>{{1, 2}, {2, 2}});
}

TEST_CASE("an interruption finishes the frame, runs what runs at the end, and closes") {
  ToyRun run(kSource + "  - {name: out, module: sink.toy, in: {number: camera.number}, when: {at_end: true}}\n");
  run.executor.on_frame = [&](auto done, auto) { run.stop = done == 2; };
  auto summary = run.run();
  CHECK(summary.interrupted);
  CHECK(summary.frames == 2);
  CHECK(Events(events().end() - 3, events().end()) == Events{"out.got 1 in 1", "camera.close 1", "out.close 1"});
}

TEST_CASE("a node that runs at the end sees the last frame's values") {
  ToyRun run(kSource + "  - {name: out, module: sink.toy, in: {number: camera.number}, when: {at_end: true}}\n");
  run.run();
  CHECK(std::count(events().begin(), events().end(), "out.got 2 in 2") == 1);
}

TEST_CASE("no frame, nothing at the end") {
  ToyRun run(
      "name: toy\nnodes:\n  - {name: camera, module: source.toy, params: {count: 0}}\n"
      "  - {name: out, module: sink.toy, in: {number: camera.number}, when: {at_end: true}}\n");
  CHECK(run.run().frames == 0);
  CHECK(events() == Events{"camera.open 0", "out.open 0", "camera.close 0", "out.close 0"});
}

TEST_CASE("a gated node passes its input through") {
  ToyRun run(
      kSource +
      "  - {name: plus, module: preprocess.plus_one, in: {number: camera.number}, when: {from_frame: 1, every: 2}}\n"
      "  - {name: out, module: sink.toy, in: {number: plus.sum}}\n");
  auto summary = run.run();
  CHECK(summary.nodes.at("plus").ms.size() == 1);
  CHECK(std::count(events().begin(), events().end(), "out.got 0 in 0") == 1);
  CHECK(std::count(events().begin(), events().end(), "out.got 2 in 1") == 1);
  CHECK(std::count(events().begin(), events().end(), "out.got 2 in 2") == 1);
}

TEST_CASE("consecutive particle nodes run as one loop") {
  ToyRun run(kFilter);
  run.run(2);
  CHECK(events() == Events{"camera.open 0", "camera.tick 0", "init.tick 0", "look.before 0", "weigh.before 0",
                           "look.after 0", "weigh.after 0", "camera.tick 1", "walk.before 1", "look.before 1",
                           "weigh.before 1", "walk.after 1", "look.after 1", "weigh.after 1", "camera.close 1"});
}

TEST_CASE("predictions are let go in the loop after which none reads them") {
  const std::string count = "  - {name: count, module: sink.toy_count}\n";
  ToyRun unread(kFilter + count);
  unread.run(3);
  CHECK(std::count(events().begin(), events().end(), "count.0 views in 1") == 1);

  ToyRun read(kFilter + count + "  - {name: again, module: weighting.toy, when: {from_frame: 2}}\n");
  read.run(3);
  CHECK(std::count(events().begin(), events().end(), "count.0 views in 1") == 1);
  CHECK(std::count(events().begin(), events().end(), "count.37 views in 2") == 1);

  // Nothing makes a prediction in frame 3, so that of frame 2 is read there.
  ToyRun later(
      "name: toy\nnodes:\n  - {name: camera, module: source.toy, params: {count: 6}}\n"
      "  - {name: init, module: map.toy, when: {until_frame: 0}, params: {particles: 37}}\n"
      "  - {name: look, module: prediction.toy, in: {number: camera.number}, when: {every: 2}}\n"
      "  - {name: weigh, module: weighting.toy}\n" + count);
  later.run(4);
  CHECK(std::count(events().begin(), events().end(), "count.37 views in 2") == 1);
  CHECK(std::count(events().begin(), events().end(), "count.0 views in 3") == 1);
}

TEST_CASE("a loop ends where a node says so, and before a node that uses what the loop makes") {
  std::string head =
      "name: toy\nnodes:\n  - {name: camera, module: source.toy, params: {count: 1}}\n"
      "  - {name: init, module: map.toy}\n";
  ToyRun ends(head +
              "  - {name: a, module: motion.toy_walk, in: {number: camera.number}, params: {ends: true}}\n"
              "  - {name: b, module: motion.toy_walk, in: {number: camera.number}}\n");
  ends.run();
  CHECK(Events(events().begin() + 3, events().begin() + 7) ==
        Events{"a.before 0", "a.after 0", "b.before 0", "b.after 0"});
  ToyRun feeds(head +
               "  - {name: a, module: prediction.toy, in: {number: camera.number}}\n"
               "  - {name: b, module: motion.toy_walk, in: {number: a.doubled}}\n");
  feeds.run();
  CHECK(Events(events().begin() + 3, events().begin() + 7) ==
        Events{"a.before 0", "a.after 0", "b.before 0", "b.after 0"});
}

TEST_CASE("the same bytes for any number of threads") {
  const auto one = digest_of(1);
  CHECK(digest_of(2) == one);
  CHECK(digest_of(4) == one);
}

TEST_CASE("metrics are columns of nodes") {
  ToyRun run(kFilter);
  run.run();
  CHECK(run.metrics.columns().at("weigh.ess").size() == 6);
  CHECK(run.metrics.to_csv().starts_with("frame,weigh.ess\n0,37\n"));
}

TEST_CASE("errors say in which node and frame they happened, and keep their type") {
  auto graph = [](const std::string& kind) {
    return kSource +
           "  - {name: init, module: map.toy, when: {until_frame: 0}}\n"
           "  - {name: boom, module: refinement.toy_throw, params: {frame: 1, kind: " +
           kind + "}}\n";
  };
  ToyRun data(graph("data"));
  CHECK_THROWS_AS(data.run(), DataError);
  ToyRun again(graph("data"));
  CHECK_THROWS_WITH(again.run(), "depth.png (frame 7): cut short (node 'boom', frame 1, particle 1)");
  ToyRun config(graph("config"));
  CHECK_THROWS_AS(config.run(), ConfigError);
  ToyRun config_again(graph("config"));
  CHECK_THROWS_WITH(config_again.run(), "toy.yaml:5:5: stride differs (node 'boom', frame 1, particle 1)");
  ToyRun standard(graph("standard"));
  CHECK_THROWS_WITH(standard.run(), "no such element (node 'boom', frame 1, particle 1)");
}
