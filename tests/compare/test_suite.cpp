#include <catch2/catch.hpp>

#include "apps/compare/suite_schema.hpp"
#include "tests/compare/suite_files.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

const std::string kTop = "name: s\ncomparisons:\n";

}  // namespace

TEST_CASE("a suite: what a comparison does not say is the suite's") {
  const SuiteFiles files;
  const auto suite = files.suite(R"(name: s
title: All
seeds: 2
threads: 3
memory: 2 GiB
time_limit: 5 min
drop: [table]
comparisons:
  - {name: a, graphs: [{name: ppm, graph: room.yaml}]}
  - {name: b, seeds: [8, 3], memory: 100 MB, views: 4, drop: [solid], graphs: [{name: x, graph: room.yaml, memory: 1 GB}, {name: y, graph: room.yaml}]}
slurm: {at_once: 4, options: [--partition=short, -A me]}
)");
  REQUIRE(suite.comparisons.size() == 2);
  const auto& a = suite.comparisons[0];
  CHECK(a.title == "a");
  CHECK(a.runs.seeds == std::vector<std::uint64_t>{1, 2});
  CHECK(a.runs.threads == 3);
  CHECK(a.runs.memory_bytes == 2.0 * 1024 * 1024 * 1024);
  CHECK(a.runs.time_limit_s == 300);
  CHECK(a.runs.views == 0);
  CHECK(a.subject == "ppm");
  CHECK(a.against.empty());
  const auto& b = suite.comparisons[1];
  CHECK(b.runs.seeds == std::vector<std::uint64_t>{8, 3});
  CHECK(b.runs.memory_bytes == 1e8);
  CHECK(b.runs.views == 4);
  CHECK(b.runs.drop.size() == 2);
  CHECK(b.subject == "x");
  CHECK(b.against == "y");
  CHECK(b.graphs[0].memory_bytes == 1e9);
  CHECK(suite.slurm_at_once == 4);
  CHECK(suite.slurm_options == std::vector<std::string>{"--partition=short", "-A me"});
  CHECK(suite.text.starts_with("name: s\ntitle: All\n"));
}

TEST_CASE("a sweep is every combination, each a graph with its values in its name") {
  const SuiteFiles files;
  const auto suite = files.suite(kTop +
                                 "  - {name: c, graphs: [{name: ppm, title: PPM, graph: room.yaml, sweep: {init.texel_size: [1 cm, 2 cm], "
                                 "look.stride: [1, 2]}}]}\n");
  const auto& graphs = suite.comparisons[0].graphs;
  REQUIRE(graphs.size() == 4);
  CHECK(graphs[0].name == "ppm[init.texel_size=1 cm,look.stride=1]");
  CHECK(graphs[1].name == "ppm[init.texel_size=1 cm,look.stride=2]");
  CHECK(graphs[3].name == "ppm[init.texel_size=2 cm,look.stride=2]");
  CHECK(graphs[3].title == "PPM, init.texel_size=2 cm,look.stride=2");
  CHECK(graphs[3].base_name == "ppm");
}

TEST_CASE("every mistake of a suite is told in one go, with its place") {
  const SuiteFiles files;
  const auto told = files.complaint(R"(name: a/b
seeds: 0
memory: 2 cm
thread: 2
comparisons:
  - name: c
    subject: pm
    seeds: [1, 1]
    sequences:
      - {name: s}
      - {name: t, like: room.yaml, nodes: []}
    graphs:
      - {name: ppm, graph: room.yaml, set: {texel_size: 1 cm}, set_for: {u: {init.texel_size: 1 cm}}}
      - {name: ppm, graph: plain.yaml, set: {init.texel_size: 1 cm}, sweep: {init.texel_size: [2 cm], a.b: 3}}
    skip: [{graph: pmp, sequence: s}]
  - {title: nameless}
)");
  INFO(told);
  for (const auto* part :
       {"SUITE:1:7: suite name 'a/b'", "SUITE:2:8: seeds: '0' is out of range", "SUITE:3:9: memory: '2 cm' is a length", "SUITE:4:1: unknown key 'thread' of the suite; did you mean 'threads'?",
        "SUITE:7:14: no graph 'pm'; did you mean 'ppm'?", "SUITE:8:16: seed 1 is there already", "SUITE:10:9: a sequence needs 'nodes', or 'like'",
        "SUITE:11:9: a sequence has 'nodes' or 'like', not both", "SUITE:13:45: 'texel_size': write node.key", "SUITE:13:74: no sequence 'u'",
        "SUITE:14:63: 'init.texel_size' is set and swept", "SUITE:14:108: a sweep is a list of values", "SUITE:15:20: no graph 'pmp'; did you mean 'ppm'?",
        "SUITE:16:5: a comparison needs the parameter 'name'", "SUITE:16:5: a comparison needs the key 'graphs'"})
    CHECK_THAT(told, Contains(part));
}

TEST_CASE("a suite that is no map, has no comparisons, or names a graph twice") {
  const SuiteFiles files;
  CHECK_THAT(files.complaint("- a\n"), Contains("SUITE:1:1: a suite is a map"));
  CHECK_THAT(files.complaint("name: s\n"), Contains("the suite needs the key 'comparisons'"));
  CHECK_THAT(files.complaint("name: s\ncomparisons: []\n"), Contains("SUITE:2:14: the suite has no comparisons"));
  CHECK_THAT(files.complaint("name: s\ncomparisons: 3\n"), Contains("SUITE:2:14: 'comparisons' must be a list"));
  CHECK_THAT(files.complaint(kTop + "  - {name: c, graphs: [{name: x, graph: room.yaml}, {name: x, graph: plain.yaml}]}\n"),
             Contains("graph name 'x' is taken, by the one at SUITE:3:24"));
  CHECK_THAT(files.complaint(kTop + "  - {name: c, against: x, graphs: [{name: x, graph: room.yaml}]}\n"), Contains("SUITE:3:24: a graph is compared with itself"));
}

namespace {

/// A suite with every key, as JSON, which is YAML too.
const char* const kEveryKey = R"({
  "name": "s", "title": "S", "seeds": 2, "threads": 1, "views": 0, "memory": "1 GB", "time_limit": "1 h", "drop": ["table"],
  "slurm": {"at_once": 2, "options": ["-p x"]},
  "comparisons": [{
    "name": "c", "title": "C", "seeds": [1], "threads": 1, "views": 0, "memory": "1 GB", "time_limit": "1 h", "drop": ["table"],
    "subject": "a[init.texel_size=1 cm]", "against": "b",
    "sequences": [{"name": "s", "title": "S", "nodes": [], "like": "plain.yaml", "frame": "eye.frame", "seed": "eye.seed", "set": {}}],
    "graphs": [
      {"name": "a", "title": "A", "graph": "room.yaml", "memory": "1 GB", "optional": true, "replace": [], "add": [], "drop": ["table"], "set": {},
       "set_for": {"s": {}}, "sweep": {"init.texel_size": ["1 cm"]}},
      {"name": "b", "graph": "room.yaml"}],
    "skip": [{"graph": "b", "sequence": "s"}]}]})";

std::vector<std::string> keys(const nlohmann::json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

}  // namespace

TEST_CASE("the schema of suites knows the keys that the reader knows, and no others") {
  const auto schema = nlohmann::json::parse(suite_schema());
  const auto all = nlohmann::json::parse(kEveryKey);
  CHECK(keys(schema["properties"]) == keys(all));
  const auto& comparison = schema["properties"]["comparisons"]["items"]["properties"];
  CHECK(keys(comparison) == keys(all["comparisons"][0]));
  CHECK(keys(comparison["sequences"]["items"]["properties"]) == keys(all["comparisons"][0]["sequences"][0]));
  CHECK(keys(comparison["graphs"]["items"]["properties"]) == keys(all["comparisons"][0]["graphs"][0]));
  CHECK(keys(comparison["skip"]["items"]["properties"]) == keys(all["comparisons"][0]["skip"][0]));
  CHECK(keys(schema["properties"]["slurm"]["properties"]) == keys(all["slurm"]));

  const SuiteFiles files;
  CHECK_THAT(files.complaint(kEveryKey), !Contains("unknown key"));
}

TEST_CASE("configs/schema/suite.schema.json is what `ppm schema --suite` prints") {
  CHECK((content(std::string(PPM_SOURCE_DIR) + "/configs/schema/suite.schema.json") == suite_schema()));
}
