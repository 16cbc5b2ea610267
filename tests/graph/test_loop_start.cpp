#include <catch2/catch.hpp>

#include "tests/support/toy_modules.hpp"

using namespace ppm;

namespace {

std::vector<double> seen_before;

/// Reads all poses before its loop, as a predictor of views does.
class Onlooker : public ParticleModule {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};
  void before(Context&) override {
    for (const auto& pose : belief->pose) seen_before.push_back(pose.translation().x());
  }
  using ParticleModule::tick;
  void tick(Context&, std::size_t, int) override {}
  bool starts_loop() const override { return true; }
  const ParticleSet& particles() const override { return *belief; }
};

}  // namespace

TEST_CASE("a node that starts a loop sees what the ticks above it wrote") {
  Registry registry = test::toy_registry();
  registry.add<Onlooker>("prediction.onlooker", "Looks at poses.", "None.");
  Graph graph = Graph::build(parse_yaml("name: toy\nnodes:\n"
                                        "  - {name: camera, module: source.toy, params: {count: 2}}\n"
                                        "  - {name: init, module: map.toy, when: {until_frame: 0}}\n"
                                        "  - {name: walk, module: motion.toy_walk, in: {number: camera.number}}\n"
                                        "  - {name: look, module: prediction.onlooker}\n",
                                        "toy.yaml"),
                             registry);
  Workers workers(2);
  Log log(LogLevel::error);
  Metrics metrics;
  Context context(workers, log, metrics, graph.seed(), {});
  Executor executor(graph, context);
  seen_before.clear();
  executor.run(2, std::atomic<bool>(false));
  REQUIRE(seen_before.size() == 8);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto path = executor.belief().trajectory[i].poses();
    CHECK(seen_before[i] == path[1].T_map_camera.translation().x());
    CHECK(seen_before[4 + i] == path[2].T_map_camera.translation().x());
  }
}
