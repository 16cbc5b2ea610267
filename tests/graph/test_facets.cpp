#include <catch2/catch.hpp>

#include "framework/graph/facet_state.hpp"
#include "tests/support/toy_modules.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// The mistakes of a graph that starts with a source; the first node given is in line 4.
std::string mistakes(const std::string& lines) {
  try {
    Graph::build(parse_yaml("name: g\nnodes:\n  - {name: camera, module: source.toy}\n" + lines, "g.yaml"),
                 ToyRun::registry());
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

std::string node(const std::string& name, const std::string& module, const std::string& rest = "") {
  return "  - {name: " + name + ", module: " + module + rest + "}\n";
}

const std::string kNumber = ", in: {number: camera.number}";
const std::string kInit = node("init", "map.toy", ", when: {until_frame: 0}");
const std::string kWalk = node("walk", "motion.toy_walk", kNumber + ", when: {from_frame: 1}");
const std::string kLook = node("look", "prediction.toy", kNumber);
const std::string kWeigh = node("weigh", "weighting.toy");

/// Adds a weighting for each period.
std::string with_every(std::string lines, const std::vector<int>& periods) {
  for (int p : periods)
    lines += node(fmt::format("weigh{}", p), "weighting.toy", fmt::format(", when: {{every: {}}}", p));
  return lines;
}

}  // namespace

TEST_CASE("a belief that has what each node needs") {
  CHECK(mistakes(kInit + kWalk + kLook + kWeigh) == "");
  CHECK(mistakes(kInit + node("save", "sink.toy_map", ", when: {at_end: true}")) == "");
}

TEST_CASE("a facet that no node gives") {
  CHECK(mistakes(kInit + kWeigh) ==
        "g.yaml:5:27: node 'weigh' needs 'prediction' on the belief, which no node gives; modules that do: "
        "prediction.toy");
  CHECK(mistakes(node("save", "sink.toy_map", ", when: {at_end: true}")) ==
        "g.yaml:4:26: node 'save' needs a map, which no node gives; modules that do: map.other, map.toy");
}

TEST_CASE("one cause gives one message") {
  CHECK(mistakes(kInit + kWeigh + node("weigh2", "weighting.toy")) == mistakes(kInit + kWeigh));
}

TEST_CASE("a map of another kind") {
  CHECK(mistakes(node("init", "map.other", ", when: {until_frame: 0}") + kLook) ==
        "g.yaml:5:26: node 'look' needs a 'toy' map, but node 'init' gives 'other'");
}

TEST_CASE("a provider below its consumer") {
  CHECK(mistakes(kInit + kWeigh + kLook) ==
        "g.yaml:5:27: node 'weigh' needs 'prediction' on the belief, but node 'look', which gives it, is below");
}

TEST_CASE("a provider that first runs too late") {
  CHECK(mistakes(kInit + node("look", "prediction.toy", kNumber + ", when: {from_frame: 5}") +
                 node("weigh", "weighting.toy", ", when: {from_frame: 1}")) ==
        "g.yaml:6:27: node 'weigh' needs 'prediction' on the belief in frame 1, but node 'look', which gives it, first "
        "runs in frame 5");
  CHECK(mistakes(node("init", "map.toy", ", when: {at_end: true}") + kWalk) ==
        "g.yaml:5:26: node 'walk' needs a belief in frame 1, but node 'init', which gives it, runs only "
        "after the last frame");
}

TEST_CASE("a facet that is dropped and not given again in time") {
  CHECK(mistakes(kInit + kWalk + node("look", "prediction.toy", kNumber + ", when: {every: 10}") + kWeigh) ==
        "g.yaml:7:27: node 'weigh' needs 'prediction' on the belief in frame 1, but node 'walk' dropped it in frame 1, "
        "and 'look', which gives it, does not run in between");
  // In step with its provider there is nothing to complain of.
  CHECK(mistakes(kInit + kWalk + node("look", "prediction.toy", kNumber + ", when: {every: 10}") +
                 node("weigh", "weighting.toy", ", when: {every: 20}")) == "");
  // Only a long look shows that 4 and 6 meet in no odd frame.
  CHECK(mistakes(kInit + kWalk + node("look", "prediction.toy", kNumber + ", when: {every: 4}") +
                 node("weigh", "weighting.toy", ", when: {every: 6}"))
            .find("in frame 6") != std::string::npos);
}

TEST_CASE("a part of a facet goes when the facet is dropped or given anew") {
  FacetState state;
  state.pass({{}, {"prediction", "prediction.elements"}, {}}, 0, 0);
  CHECK(state.has("prediction.elements"));
  state.pass({{}, {"prediction"}, {}}, 1, 0);
  CHECK(state.has("prediction"));
  CHECK_FALSE(state.has("prediction.elements"));
  CHECK(state.last("prediction.elements")->node == 1);
  state.pass({{}, {"prediction.elements", "prediction"}, {}}, 2, 0);
  CHECK(state.has("prediction.elements"));
  state.pass({{}, {}, {"prediction"}}, 3, 0);
  CHECK_FALSE(state.has("prediction.elements"));
  CHECK(speak_of({"belief", "prediction.elements"}, "prediction"));
  CHECK_FALSE(speak_of({"predictions", "map.ppm"}, "prediction"));
}

TEST_CASE("gates far away are looked at") {
  CHECK(mistakes(kInit + kWalk + node("look", "prediction.toy", kNumber + ", when: {until_frame: 1000000}") + kWeigh)
            .find("in frame 1000001") != std::string::npos);
}

TEST_CASE("gates of any size are looked at in no time") {
  const std::string huge = ", when: {from_frame: 1000000000000, every: 999999999989}";
  CHECK(mistakes(kInit + kWalk + kLook + node("weigh", "weighting.toy", huge)) == "");
  CHECK(mistakes(with_every(kInit + kWalk + kLook, {7, 11, 13, 17, 19})) == "");
}
