#include <catch2/catch.hpp>

#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// All mistakes of a graph, one a line, as a user sees them; "" where there is none.
std::string mistakes(const std::string& yaml, const std::vector<Override>& overrides = {}) {
  try {
    Graph::build(parse_yaml(yaml, "g.yaml"), ToyRun::registry(), overrides);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

const std::string kHead = "name: g\nnodes:\n  - {name: camera, module: source.toy}\n";

std::string with(const std::string& lines) {
  return kHead + lines;
}

}  // namespace

TEST_CASE("keys of the file and of a node") {
  CHECK(mistakes(kHead) == "");
  CHECK(mistakes("") == "g.yaml:1:1: a graph file is a map with name and nodes, not nothing");
  CHECK(mistakes("name: g\n") == "g.yaml:1:1: the graph needs the key 'nodes'");
  CHECK(mistakes("name: g\nnodes: []\n") == "g.yaml:2:8: the graph has no nodes");
  CHECK(mistakes("name: g\nnodes: 3\n") == "g.yaml:2:8: 'nodes' must be a list, not a single value");
  CHECK(mistakes("nme: g\nnodes:\n  - {name: camera, module: source.toy}\n") ==
        "g.yaml:1:1: unknown key 'nme' of the graph; did you mean 'name'?\n"
        "g.yaml:1:1: the graph needs the key 'name'");
  CHECK(mistakes(with("  - {name: a, module: map.toy, wen: {every: 2}}\n")) ==
        "g.yaml:4:32: unknown key 'wen' of a node; did you mean 'when'?");
  CHECK(mistakes(with("  - {name: a, module: map.toy, zzz: 1}\n")) ==
        "g.yaml:4:32: unknown key 'zzz' of a node; keys: name, module, in, when, params");
  CHECK(mistakes(with("  - {module: map.toy}\n")) == "g.yaml:4:5: a node needs the key 'name'");
  CHECK(mistakes(with("  - {name: a}\n")) == "g.yaml:4:5: a node needs the key 'module'");
  CHECK(mistakes(with("  - just words\n")) ==
        "g.yaml:4:5: a node is a map such as {name: x, module: y}, not a single value");
  CHECK(mistakes("name: g\nseed: -1\nnodes:\n  - {name: camera, module: source.toy}\n")
            .starts_with("g.yaml:2:7: seed: "));
  CHECK(mistakes("name: g\nplugins: x.so\nnodes:\n  - {name: camera, module: source.toy}\n") ==
        "g.yaml:2:10: plugins is a list of libraries, not a single value");
}

TEST_CASE("names of nodes and modules") {
  CHECK(mistakes(with("  - {name: 2nd, module: map.toy}\n")) ==
        "g.yaml:4:12: node name '2nd': a letter first, then letters, digits and '_'");
  CHECK(mistakes(with("  - {name: camera, module: map.toy}\n")) ==
        "g.yaml:4:12: node name 'camera' is taken, by the node at g.yaml:3:5");
  CHECK(mistakes(with("  - {name: a, module: map.tyo}\n")) ==
        "g.yaml:4:23: unknown module 'map.tyo'; did you mean 'map.toy'? (category 'map' has map.other, map.toy)");
  CHECK(mistakes(with("  - {name: a, module: nothing.like_it}\n")) ==
        "g.yaml:4:23: unknown module 'nothing.like_it' (categories: map, motion, prediction, preprocess, refinement, "
        "resampling, sink, source, weighting)");
}

TEST_CASE("parameters are checked") {
  CHECK(mistakes(with("  - {name: a, module: map.toy, params: {partcles: 3}}\n"))
            .starts_with("g.yaml:4:41: map.toy has no parameter 'partcles'; did you mean 'particles'?"));
  CHECK(mistakes(with("  - {name: a, module: map.toy, params: {particles: 0}}\n"))
            .starts_with("g.yaml:4:52: particles: "));
}

TEST_CASE("inputs are wired to outputs above, of the same type") {
  const std::string plus = "  - {name: plus, module: preprocess.plus_one, in: {number: ";
  CHECK(mistakes(with(plus + "camera.number}}\n")) == "");
  CHECK(mistakes(with("  - {name: plus, module: preprocess.plus_one}\n")) ==
        "g.yaml:4:26: input 'number' of module 'preprocess.plus_one' is not wired; "
        "did you mean in: {number: camera.number}?");
  CHECK(mistakes(with(plus + "camera.number}}\n  - {name: out, module: sink.toy}\n")) ==
        "g.yaml:5:25: input 'number' of module 'sink.toy' is not wired; "
        "outputs of its type above: camera.number, plus.sum");
  CHECK(mistakes("name: g\nnodes:\n  - {name: out, module: sink.toy}\n  - {name: camera, module: source.toy}\n") ==
        "g.yaml:3:25: input 'number' of module 'sink.toy' is not wired; no node above makes a 'number'");
  CHECK(mistakes(with(plus + "camera}}\n")) == "g.yaml:4:60: an input is written as node.output, such as camera.frame");
  CHECK(mistakes(with(plus + "camra.number}}\n")) == "g.yaml:4:60: no node 'camra' above; did you mean 'camera'?");
  CHECK(mistakes(with(plus + "camera.numbr}}\n")) ==
        "g.yaml:4:60: node 'camera' has no output 'numbr'; did you mean 'number'?");
  CHECK(mistakes(with(plus + "camera.image}}\n")) ==
        "g.yaml:4:60: node 'camera' has no output 'image'; its outputs: number");
  CHECK(mistakes(with(plus + "plus.sum}}\n")) == "g.yaml:4:60: node 'plus' cannot use its own output");
  CHECK(mistakes(with(plus + "late.sum}}\n  - {name: late, module: preprocess.plus_one, in: {number: plus.sum}}\n")) ==
        "g.yaml:4:60: node 'late' is below; nodes use only what was made above them");
  CHECK(mistakes(with("  - {name: plus, module: preprocess.plus_one, in: {nmber: camera.number}}\n")) ==
        "g.yaml:4:52: module 'preprocess.plus_one' has no input 'nmber'; did you mean 'number'?");
  CHECK(mistakes(with("  - {name: init, module: map.toy, in: {belief: camera.number}}\n")) ==
        "g.yaml:4:40: the belief needs no 'in' line: it goes through the nodes from top to bottom");
  CHECK(mistakes(with("  - {name: out, module: sink.toy, in: camera.number}\n")) ==
        "g.yaml:4:39: 'in' is a map such as {frame: camera.frame}, not a single value");
}

TEST_CASE("an input takes its own type only") {
  CHECK(mistakes(with("  - {name: other, module: source.toy_word}\n"
                      "  - {name: out, module: sink.toy, in: {number: other.word}}\n")) ==
        "g.yaml:5:48: input 'number' takes a 'number', but 'other.word' is a 'word'");
}

TEST_CASE("gates") {
  const std::string node = "  - {name: a, module: map.toy, when: ";
  CHECK(mistakes(with(node + "{from_frame: 1, until_frame: 5, every: 2}}\n")) == "");
  CHECK(mistakes(with(node + "{at_end: true}}\n")) == "");
  CHECK(mistakes(with(node + "{evry: 2}}\n")).starts_with("g.yaml:4:39: when has no parameter 'evry'"));
  CHECK(mistakes(with(node + "{every: 0}}\n")).starts_with("g.yaml:4:46: every: "));
  CHECK(mistakes(with(node + "{from_frame: -1}}\n")).starts_with("g.yaml:4:51: from_frame: "));
  CHECK(mistakes(with(node + "{at_end: true, every: 2}}\n")) ==
        "g.yaml:4:38: at_end excludes from_frame, until_frame and every");
  CHECK(mistakes(with(node + "{from_frame: 5, until_frame: 2}}\n")) ==
        "g.yaml:4:38: never runs: until_frame 2 is before from_frame 5");
  CHECK(
      mistakes("name: g\nnodes:\n  - {name: camera, module: source.toy, when: {every: 2}}\n") ==
      "g.yaml:3:46: module 'source.toy' cannot have 'when': nothing stands in for its output 'number' in frames where "
      "it does not run");
}

TEST_CASE("a graph has a source") {
  CHECK(mistakes("name: g\nnodes:\n  - {name: init, module: map.toy}\n") ==
        "g.yaml:3:3: the graph has no source of frames; modules that are one: source.toy, source.toy_word");
}

TEST_CASE("values given with --set pass the checks of the file") {
  const std::string graph = with("  - {name: init, module: map.toy}\n");
  auto built = Graph::build(parse_yaml(graph, "g.yaml"), ToyRun::registry(),
                            {parse_override("init.particles=9"), parse_override("seed=12")});
  CHECK(built.seed() == 12);
  CHECK(built.effective_yaml().find("particles: 9") != std::string::npos);
  CHECK(mistakes(graph, {parse_override("init.particles=none")})
            .starts_with("--set init.particles=none:1:16: particles: "));
  CHECK(mistakes(graph, {parse_override("init.partcles=3")})
            .starts_with("--set init.partcles=3:1:15: map.toy has no parameter"));
  CHECK(mistakes(graph, {parse_override("inti.particles=3")}) ==
        "--set inti.particles=3:1:16: no node 'inti'; did you mean 'init'?");
  CHECK(mistakes(graph, {parse_override("sed=3")}) ==
        "--set sed=3:1:5: unknown key 'sed' of the graph; did you mean 'seed'?");
  const std::string broken = with("  - {name: init, module: map.toy, params: 3}\n");
  CHECK(mistakes(broken, {parse_override("init.particles=3")}) == mistakes(broken));
  CHECK_THROWS_WITH(parse_override("init.particles"), "--set init.particles: write node.key=value");
  CHECK_THROWS_WITH(parse_override(".particles=3"), "--set .particles=3: write node.key=value");
}

TEST_CASE("eleven mistakes give eleven messages in the order of the file") {
  const auto text = mistakes(
      "name: g\n"
      "sed: 3\n"
      "nodes:\n"
      "  - {name: camera, module: source.toy, params: {cout: 3}}\n"
      "  - {name: camera, module: map.toy, params: {particles: many}}\n"
      "  - {name: walk, module: motion.toy_wlak, in: {number: camera.number}, params: {sigma: 2 deg}}\n"
      "  - {name: look, module: prediction.toy}\n"
      "  - {name: weigh, module: weighting.toy, when: {every: 0}}\n"
      "  - {name: out, module: sink.toy, in: {number: camera.nmber}}\n"
      "  - {name: 7up, module: sink.toy, in: {number: later.sum}}\n"
      "  - {name: later, module: preprocess.plus_one, in: {number: camera.number}}\n");
  INFO(text);
  CHECK(std::count(text.begin(), text.end(), '\n') + 1 == 11);
  const std::vector<std::string> places{
      "g.yaml:2:1:",  "g.yaml:4:49:", "g.yaml:5:12:", "g.yaml:5:57:",  "g.yaml:6:26:", "g.yaml:6:88:",
      "g.yaml:7:26:", "g.yaml:8:56:", "g.yaml:9:48:", "g.yaml:10:12:", "g.yaml:10:48:"};
  std::size_t at = 0;
  for (const auto& place : places) {
    INFO(place);
    at = text.find(place, at);
    REQUIRE(at != std::string::npos);
  }
}

TEST_CASE("the effective graph builds the same graph") {
  const auto yaml = with(
      "  - {name: init, module: map.toy, when: {until_frame: 0}}\n"
      "  - {name: walk, module: motion.toy_walk, in: {number: camera.number}, when: {from_frame: 1}, params: {sigma: 2 "
      "cm}}\n"
      "  - {name: save, module: sink.toy_map, when: {at_end: true}}\n");
  const auto once = Graph::build(parse_yaml(yaml, "g.yaml"), ToyRun::registry()).effective_yaml();
  CHECK(once.find("sigma: 0.02") != std::string::npos);
  CHECK(Graph::build(parse_yaml(once, "e.yaml"), ToyRun::registry()).effective_yaml() == once);
}
