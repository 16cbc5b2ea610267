// A run that goes on from its checkpoint ends with the bytes of the run that never stopped.
#include "tests/apps/resumed.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a run killed in its middle goes on and ends with the same bytes") {
  WindyRoom room;
  room.run_whole();
  auto run = start_ppm(room.arguments(room.out, {"--checkpoint-every", "7", "--threads", "2"}));
  wait_for(room.out / "run.checkpoint");
  run->send(SIGKILL);
  run->wait();
  REQUIRE(run->signal == SIGKILL);
  REQUIRE_FALSE(fs::exists(room.out / "run.json"));

  const auto resumed = ppm_command({"run", "--resume", room.out.string(), "--threads", "4"});
  INFO(resumed->err);
  REQUIRE(resumed->code == 0);
  CHECK_THAT(resumed->out, Contains("done: 48 frames"));
  same_results(room.whole, room.out);
  const auto report = read_json(room.out / "run.json");
  REQUIRE(report["resumed"].size() == 1);
  CHECK(report["resumed"][0].get<int>() % 7 == 0);
  CHECK(report["graph_file"] == room.graph);
  CHECK(report["checkpoints"]["frame"] == 42);  // the interval goes on, too
  CHECK(half_written(room.out).empty());
}

TEST_CASE("a run may be killed again and again") {
  WindyRoom room;
  room.run_whole();
  REQUIRE(ppm_command(room.arguments(room.out, {"--checkpoint-every", "10", "--frames", "13"}))->code == 0);
  for (const char* frames : {"21", "33"}) {
    const auto part = ppm_command({"run", "--resume", room.out.string(), "--frames", frames, "--quiet"});
    INFO(part->err);
    REQUIRE(part->code == 0);
    CHECK(read_json(room.out / "run.json")["frames"] == std::stoi(frames));
  }
  REQUIRE(ppm_command({"run", "--resume", room.out.string(), "--frames", "1000", "--quiet"})->code == 0);
  same_results(room.whole, room.out);
  CHECK(read_json(room.out / "run.json")["resumed"] == std::vector<int>{10, 20, 30});
}

TEST_CASE("Ctrl-C leaves a checkpoint, also where none was asked for") {
  WindyRoom room;
  room.run_whole();
  auto run = start_ppm({"run", room.graph, "--plugin", room.plugin, "--out", room.out.string()});
  wait_for(room.out / "config.effective.yaml");
  run->send(SIGINT);
  run->wait();
  INFO(run->err);
  REQUIRE(run->code == 1);
  CHECK_THAT(run->out, Contains("to go on: ppm run --resume " + room.out.string()));
  CHECK(read_json(room.out / "run.json")["interrupted"] == true);
  REQUIRE(ppm_command({"run", "--resume", room.out.string(), "--quiet"})->code == 0);
  same_results(room.whole, room.out);
}

TEST_CASE("a limit of frames holds for the run as a whole") {
  WindyRoom room;
  REQUIRE(ppm_command(room.arguments(room.out, {"--checkpoint-every", "4", "--frames", "9"}))->code == 0);
  const auto digest = read_json(room.out / "run.json")["digest"];
  REQUIRE(ppm_command({"run", "--resume", room.out.string(), "--quiet"})->code == 0);
  CHECK(read_json(room.out / "run.json")["frames"] == 9);
  CHECK(read_json(room.out / "run.json")["digest"] == digest);
  // Nothing is left to do but the end.
  REQUIRE(ppm_command({"run", "--resume", room.out.string(), "--quiet", "--frames", "8"})->code == 0);
  CHECK(read_json(room.out / "run.json")["frames"] == 8);
}

TEST_CASE("the graph may say how often a checkpoint is kept, the command line may say otherwise") {
  WindyRoom room;
  write_text(room.graph, std::string("checkpoint_every: 2\n") + kWindyRoom);
  REQUIRE(ppm_command(room.arguments(room.out, {"--frames", "5"}))->code == 0);
  CHECK(read_json(room.out / "run.json")["checkpoints"]["written"] == 2);
  REQUIRE(ppm_command({"run", "--resume", room.out.string(), "--quiet", "--frames", "8", "--checkpoint-every", "0"})->code == 0);
  CHECK_FALSE(read_json(room.out / "run.json").contains("checkpoints"));
  REQUIRE(ppm_command(room.arguments(room.out, {"--frames", "5", "--checkpoint-every", "0"}))->code == 0);
  CHECK_FALSE(fs::exists(room.out / "run.checkpoint"));  // that of the earlier run is gone with its results
}

TEST_CASE("a new run may replace one that was killed") {
  WindyRoom room;
  auto run = start_ppm(room.arguments(room.out, {"--checkpoint-every", "5"}));
  wait_for(room.out / "run.checkpoint");
  run->send(SIGKILL);
  run->wait();
  const auto again = ppm_command(room.arguments(room.out, {"--frames", "2"}));
  INFO(again->err);
  CHECK(again->code == 0);
  CHECK_FALSE(fs::exists(room.out / "run.checkpoint"));
}
