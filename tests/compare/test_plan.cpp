#include <catch2/catch.hpp>

#include "apps/compare/compose.hpp"
#include "tests/compare/suite_files.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

const std::string kTop = "name: s\ncomparisons:\n";

}  // namespace

TEST_CASE("a composed graph: the sequence's nodes, inputs wired to its frame, nodes dropped, values set") {
  const SuiteFiles files;
  const auto plan = files.plan(R"(name: s
seeds: [4]
drop: [sink.metrics]
comparisons:
  - name: c
    sequences: [{name: short, like: plain.yaml, set: {eye.frames: 2}}]
    graphs: [{name: ppm, graph: room.yaml, set: {init.texel_size: 3 cm}, set_for: {short: {look.stride: 2}}}]
)");
  REQUIRE(plan.jobs.size() == 1);
  CHECK(plan.jobs[0].job.name() == "c/short/ppm/4");
  CHECK(plan.jobs[0].job.folder == "runs/c/short/ppm/seed_4");
  CHECK(plan.jobs[0].graph_yaml == R"(name: ppm.short
nodes:
  - name: eye
    module: source.synthetic_room
    params:
      frames: 2
      pixel_stride: 8
  - name: init
    module: map.ppm_empty
    in:
      frame: eye.frame
    when:
      until_frame: 0
    params:
      particles: 1
      texel_size: 3 cm
  - name: motion
    module: motion.reference_pose
    in:
      frame: eye.frame
    when:
      from_frame: 1
  - name: look
    module: prediction.raster
    in:
      frame: eye.frame
    params:
      stride: 2
  - name: update
    module: map_update.ppm_bayes
    in:
      frame: eye.frame
)");
}

TEST_CASE("nodes of a graph are replaced and added, and read the sequence's frame") {
  const SuiteFiles files;
  const auto plan = files.plan(R"(name: s
comparisons:
  - name: c
    sequences: [{name: short, like: plain.yaml}]
    graphs:
      - name: other
        graph: room.yaml
        drop: [solid, motion, table]
        replace: [{name: look, module: prediction.embree, in: {frame: solid.frame}}]
        add: [{after: update, name: adjust, module: refinement.vertex_adjust}, {after: init, name: walk, module: motion.random_walk, in: {frame: solid.frame}}]
)");
  REQUIRE(plan.jobs.size() == 1);
  const auto& yaml = plan.jobs[0].graph_yaml;
  std::vector<std::string> names;
  for (auto at = yaml.find("- name: "); at != std::string::npos; at = yaml.find("- name: ", at + 1))
    names.push_back(yaml.substr(at + 8, yaml.find('\n', at) - at - 8));
  CHECK(names == std::vector<std::string>{"eye", "init", "walk", "look", "update", "adjust"});
  CHECK(yaml.find("module: prediction.embree\n    in:\n      frame: eye.frame\n") != std::string::npos);
  CHECK(yaml.find("solid.frame") == std::string::npos);
}

TEST_CASE("nodes that are to be replaced or followed must be there") {
  const SuiteFiles files;
  const auto what = files.complaint(kTop + "  - name: c\n    graphs:\n      - name: a\n        graph: room.yaml\n"
                                           "        replace: [{name: loook, module: prediction.embree}]\n"
                                           "        add: [{after: upd, name: x, module: refinement.remesh}, {name: y}]\n");
  CHECK_THAT(what, Catch::Contains("the node needs 'after'"));
  const auto unknown = files.complaint(kTop + "  - name: c\n    graphs:\n      - name: a\n        graph: room.yaml\n"
                                              "        replace: [{name: loook, module: prediction.embree}]\n"
                                              "        add: [{after: upd, name: x, module: refinement.remesh}]\n");
  CHECK_THAT(unknown, Catch::Contains("SUITE:7:19: the graph has no node 'loook'"));
  CHECK_THAT(unknown, Catch::Contains("SUITE:8:15: the graph has no node 'upd'"));
}

TEST_CASE("a parameter may get the run's seed, so that noise differs from seed to seed") {
  const SuiteFiles files;
  const auto plan = files.plan(R"(name: s
seeds: [4, 9]
comparisons:
  - name: c
    sequences: [{name: room, like: room.yaml, seed: camera.seed}]
    graphs: [{name: ppm, graph: room.yaml}]
)");
  REQUIRE(plan.jobs.size() == 2);
  CHECK(plan.jobs[0].graph_yaml.find("seed: 4\n") != std::string::npos);
  CHECK(plan.jobs[1].graph_yaml.find("seed: 9\n") != std::string::npos);
  CHECK(plan.jobs[0].job.experiment != plan.jobs[1].job.experiment);
  CHECK_THAT(files.complaint(kTop + "  - name: c\n    sequences: [{name: r, like: room.yaml, seed: camera}]\n"
                                    "    graphs: [{name: a, graph: room.yaml}]\n"),
             Catch::Contains("SUITE:4:50: 'camera': write node.key"));
}

TEST_CASE("a sequence may say which frame is read, without sequences a graph keeps its own frames") {
  const SuiteFiles files;
  const auto plan = files.plan(kTop + R"(  - name: a
    sequences:
      - {name: raw, nodes: [{name: cam, module: source.synthetic_room}, {name: far, module: preprocess.gate, in: {frame: cam.frame}}], frame: cam.frame}
    graphs: [{name: ppm, graph: plain.yaml}]
  - {name: b, graphs: [{name: ppm, graph: room.yaml}]}
)");
  REQUIRE(plan.jobs.size() == 2);
  CHECK_THAT(plan.jobs[0].graph_yaml, Contains("name: look\n    module: prediction.raster\n    in:\n      frame: cam.frame"));
  CHECK(plan.jobs[1].job.sequence == kOwnFrames);
  CHECK_THAT(plan.jobs[1].graph_yaml, Contains("name: ppm.own") && Contains("frame: solid.frame") && !Contains("seed"));
}

TEST_CASE("jobs: every graph on every sequence for every seed, less what is skipped") {
  const SuiteFiles files;
  const auto plan = files.plan(kTop + R"(  - name: c
    seeds: 2
    sequences: [{name: s, like: room.yaml}, {name: t, like: plain.yaml}]
    graphs:
      - {name: a, graph: room.yaml}
      - {name: b, graph: room.yaml, sweep: {init.texel_size: [1 cm, 2 cm]}}
    skip: [{graph: b, sequence: t}, {graph: "b[init.texel_size=2 cm]", sequence: s}]
)");
  std::vector<std::string> folders;
  for (const auto& p : plan.jobs) folders.push_back(p.job.folder.string());
  CHECK(folders == std::vector<std::string>{"runs/c/s/a/seed_1", "runs/c/s/a/seed_2", "runs/c/s/b_init.texel_size=1_cm/seed_1",
                                            "runs/c/s/b_init.texel_size=1_cm/seed_2", "runs/c/t/a/seed_1", "runs/c/t/a/seed_2"});
  for (std::size_t i = 0; i < plan.jobs.size(); ++i) CHECK(plan.jobs[i].job.id == static_cast<int>(i));
  CHECK(plan.jobs[0].job.experiment != plan.jobs[1].job.experiment);
  CHECK(plan.jobs[0].graph_yaml == plan.jobs[1].graph_yaml);
}

TEST_CASE("names as folders") {
  CHECK(folder_name("ppm") == "ppm");
  CHECK(folder_name("p[a.b=1 cm,c.d=x/y]") == "p_a.b=1_cm,c.d=x_y");
}

TEST_CASE("names that become one folder's are told apart") {
  const SuiteFiles files;
  const auto plan = files.plan(kTop + "  - {name: c, graphs: [{name: a, graph: room.yaml, sweep: {init.texel_size: [1 cm, 1  cm]}}]}\n");
  REQUIRE(plan.jobs.size() == 2);
  CHECK(plan.jobs[0].job.folder != plan.jobs[1].job.folder);
}

TEST_CASE("mistakes of composed graphs come with those of the suite's values, each once") {
  const SuiteFiles files;
  write_text(files.folder / "wrong.yaml", "name: wrong\nnodes:\n  - {name: eye, module: source.synthetic_room}\n  - {name: init, module: map.pmp_empty, in: {frame: eye.frame}}\n");
  write_text(files.folder / "empty.yaml", "");
  const auto told = files.complaint(R"(name: s
drop: [tabel]
comparisons:
  - name: c
    sequences: [{name: x, like: plain.yaml}, {name: y, like: room.yaml, set: {cam.frames: 3}}, {name: z, like: plain.yaml, frame: ey.frame}]
    graphs:
      - {name: a, graph: wrong.yaml}
      - {name: b, graph: room.yaml, set: {init.texel_sise: 1 cm, init.max_edge: 2 deg}, set_for: {x: {inti.texel_size: 3 cm}}}
      - {name: d, graph: none.yaml}
      - {name: e, graph: empty.yaml}
)");
  INFO(told);
  for (const auto* part : {"DIR/wrong.yaml:4:26: unknown module 'map.pmp_empty'; did you mean 'map.ppm_empty'?", "SUITE:2:8: no graph has a node or module 'tabel'",
                           "SUITE:5:91: no node 'cam'", "no node 'ey' above; did you mean 'eye'? (a on z in c)", "SUITE:8:60: map.ppm_empty has no parameter 'texel_sise'; did you mean 'texel_size'?",
                           "SUITE:8:120: no node 'inti'; did you mean 'init'?", "SUITE:9:26: no graph file 'DIR/none.yaml'", "DIR/empty.yaml:1:1: a graph file is a map"})
    CHECK_THAT(told, Contains(part));
  const std::string once = "did you mean 'map.ppm_empty'?";
  CHECK(told.find(once) == told.rfind(once));
}

TEST_CASE("plug-ins of a graph are named by absolute paths in the experiment") {
  Config graph = parse_yaml("name: g\nplugins: [../lib/x.so]\nnodes: []\n", "/home/me/graphs/g.yaml");
  Diagnostics mistakes;
  CHECK_THAT(compose(graph, "n", {}, mistakes).to_yaml(), Contains("plugins: [/home/me/lib/x.so]"));
}

TEST_CASE("an optional graph is left out where a module of it is not there, the subject cannot be") {
  const SuiteFiles files;
  write_text(files.folder / "octo.yaml", "name: octo\nnodes:\n  - {name: eye, module: source.synthetic_room}\n  - {name: init, module: map.of_others, in: {frame: eye.frame}}\n");
  write_text(files.folder / "gone.yaml", "name: gone\nplugins: [no_such.so]\nnodes:\n  - {name: eye, module: source.synthetic_room}\n");
  const auto plan = files.plan(kTop + R"(  - name: c
    against: octo
    graphs: [{name: a, graph: plain.yaml}, {name: octo, graph: octo.yaml, optional: true}, {name: gone, graph: gone.yaml, optional: true}, {name: b, graph: room.yaml}]
)");
  CHECK(plan.jobs.size() == 2);
  REQUIRE(plan.left_out.size() == 2);
  CHECK(plan.left_out[0].reason == "there is no module 'map.of_others'");
  CHECK_THAT(plan.left_out[1].reason, Contains("no_such.so"));
  CHECK(plan.suite.comparisons[0].against == "b");
  CHECK_THAT(files.complaint(kTop + "  - {name: c, graphs: [{name: octo, graph: octo.yaml, optional: true}, {name: b, graph: room.yaml}]}\n"),
             Contains("SUITE:3:5: the subject 'octo' of 'c' is left out"));
}
