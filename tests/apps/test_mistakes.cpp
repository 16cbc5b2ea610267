#include <catch2/catch.hpp>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("ten mistakes in one file give ten messages with their places, and exit code 2") {
  TempFolder folder;
  const auto graph = (folder / "ten.yaml").string();
  write_text(
      graph,
      "name: ten\n"
      "seed: seven\n"  // 2:7 no number
      "nodes:\n"
      "  - {name: camera, module: source.synthetic_roam}\n"  // 4:28 unknown module
      "  - {name: room, module: source.synthetic_room, params: {frames: 1.5, framse: 3, holdout: every tenth}}\n"  // 5:
                                                                                                                   // three
      "  - {name: init, module: map.ppm_empty, in: {frame: room.frame}, when: {until: 0}, params: {particles: 0}}\n"  // 6: two
      "  - {name: motion, module: motion.constant_velocity, in: {frame: rom.frame}, params: {sigma_t: 2 deg}}\n"  // 7:
                                                                                                                  // two
      "  - {name: look, module: prediction.embree}\n");  // 8: unwired
  for (const char* command : {"check", "run"}) {
    const auto run = ppm_command({command, graph});
    CHECK(run->code == 2);
    CHECK(run->out.empty());
    const auto told = lines(run->err);
    INFO(run->err);
    REQUIRE(told.size() == 10);
    const std::vector<std::string> starts{":2:7: ", ":4:28: ", ":5:", ":5:", ":5:", ":6:", ":6:", ":7:", ":7:", ":8:"};
    for (std::size_t i = 0; i < told.size(); ++i) CHECK_THAT(told[i], StartsWith(graph + starts[i]));
    CHECK_THAT(run->err, Contains("did you mean 'source.synthetic_room'?") && Contains("did you mean 'frames'?") &&
                             Contains("'2 deg' is an angle; a length is wanted"));
  }
}

TEST_CASE("mistakes of --set have a place in what was typed, and come together with those of the file") {
  SmallRoom room;
  auto complaint = [&](std::vector<std::string> set) {
    std::vector<std::string> arguments{"check", room.graph};
    for (auto& s : set) {
      arguments.emplace_back("--set");
      arguments.push_back(std::move(s));
    }
    const auto check = ppm_command(std::move(arguments));
    CHECK(check->code == 2);
    return check->err;
  };
  CHECK_THAT(complaint({"motion.sigma_t=2 deg"}),
             Contains("--set motion.sigma_t=2 deg:1:16: sigma_t: '2 deg' is an angle"));
  CHECK_THAT(complaint({"motion.sigma_tt=2"}), Contains("did you mean 'sigma_t'?"));
  CHECK_THAT(complaint({"moton.sigma_t=2 cm"}), Contains("no node 'moton'") && Contains("did you mean 'motion'?"));
  CHECK_THAT(complaint({"motion.sigma_t"}), Contains("write node.key=value"));
  CHECK_THAT(complaint({"motion.sigma_t=[1"}), Contains("YAML syntax"));
  CHECK(lines(complaint({"motion", "motion.sigma_t=2 s", "init.particles=many"})).size() == 3);

  write_text(room.graph, content(room.graph) + "  - {name: x, module: no.such}\n");
  CHECK(lines(complaint({"motion.sigma_t=2 s"})).size() == 2);
}

TEST_CASE("options --set and --seed reach the graph") {
  SmallRoom room;
  const auto run =
      room.run({"--frames", "1", "--set", "init.particles=3", "--set", "motion.sigma_t=1 cm", "--seed", "12"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK_THAT(content(room.out / "config.effective.yaml"),
             Contains("particles: 3\n") && Contains("sigma_t: 0.01\n") && Contains("seed: 12\n"));
}

TEST_CASE("a command line that makes no sense ends with 2 and says why") {
  const std::vector<std::vector<std::string>> lines_of_nonsense{{},
                                                                {"fly"},
                                                                {"run"},
                                                                {"run", "a.yaml", "--frames", "0"},
                                                                {"run", "a.yaml", "--frames", "x"},
                                                                {"run", "a.yaml", "--threads", "-1"},
                                                                {"check", "a.yaml", "--nonsense"},
                                                                {"evaluate"},
                                                                {"run", "a.yaml", "--seed", "-1"}};
  for (const auto& arguments : lines_of_nonsense) {
    CAPTURE(arguments);
    const auto run = ppm_command(arguments);
    CHECK(run->code == 2);
    CHECK_FALSE(run->err.empty());
  }
  CHECK(ppm_command({"--help"})->code == 0);
  CHECK(ppm_command({"run", "--help"})->code == 0);
  CHECK_THAT(ppm_command({"--version"})->out, StartsWith("ppm "));
}

TEST_CASE("a graph's name cannot lead its results out of the folder of runs") {
  SmallRoom room;
  for (const char* name : {"../evil", "/evil", "..", "a/b", "\"\"", "-x", "two words"}) {
    CAPTURE(name);
    auto text = content(room.graph);
    text.replace(text.find("small"), 5, name);
    write_text(room.folder / "named.yaml", text);
    const auto check = ppm_command({"check", (room.folder / "named.yaml").string()});
    CHECK(check->code == 2);
    CHECK_THAT(check->err, Contains("named.yaml:1:7: graph name"));
  }
}

TEST_CASE("files that are not there") {
  TempFolder folder;
  const auto no = (folder / "no.yaml").string();
  for (const char* command : {"run", "check", "graph"}) {
    const auto run = ppm_command({command, no});
    CHECK(run->code == 2);
    CHECK(run->err == no + ": cannot read: No such file or directory\n");
  }
  const auto plugin = ppm_command({"list", "--plugin", (folder / "no.so").string()});
  CHECK(plugin->code == 2);
  CHECK_THAT(plugin->err, Contains("no.so"));
}
