// What a frame of the filter costs a particle, and its map update alone, with maps of their own.
#include <benchmark/benchmark.h>

#include "apps/bench/bench_case.hpp"
#include "apps/bench/bench_filter.hpp"

namespace ppm {
namespace {

// As in the graphs that ship: from poses much worse than a filter's the update would take the edges of things for new
// surface.
constexpr const char* kJitter = "{sigma_t: 3 mm, sigma_r: 0.2 deg}";
constexpr const char* kFastest = "prediction.raster";  // where one back-end must do
constexpr int kLarge = 200000;  // triangles: from there on fewer particles, so that their maps fit into memory
// Flat enough that most particles live: the cost of a frame is that of distinct particles.
constexpr const char* kFlatWeights = "{pixels: 0, temper: 1e-6}";

/// How the particles' maps are held.
enum class Maps {
  own,     ///< each particle's is its own, and the update writes in place
  cloned,  ///< the same, but all that the update writes is cloned, in every frame
};

struct FrameSetup {
  std::string group, backend;
  int triangles, particles, threads;
  Maps maps;
};

BenchFilter filter_of(const FrameSetup& s) {
  BenchFilter filter;
  filter.particles = s.particles;
  filter.threads = s.threads;
  filter.own_maps = true;
  filter.clones = s.maps == Maps::cloned;
  filter.look = s.backend;
  filter.weigh = "weighting.robust";
  filter.weigh_params = kFlatWeights;
  filter.ess_below = 0.5;
  filter.update = "map_update.ppm_bayes";
  filter.jitter = kJitter;
  return filter;
}

BenchCase frame_case(const BenchPlan& plan, const FrameSetup& s) {
  BenchCase c;
  c.group = s.group;
  c.item = "particle and frame";
  c.settings = {{"backend", s.backend},
                {"maps", s.maps == Maps::own ? "own" : "cloned"},
                {"triangles", std::to_string(s.triangles)},
                {"particles", std::to_string(s.particles)},
                {"threads", std::to_string(s.threads)}};
  c.run = [&plan, s](benchmark::State& state) {
    BenchWorld& world = plan.worlds.of(s.triangles, plan.cols);
    const BenchFilter filter = filter_of(s);
    const std::vector<std::string> nodes = s.group == "update"
                                               ? std::vector<std::string>{"update"}
                                               : std::vector<std::string>{"look", "weigh", "pick", "update"};
    double items = 0, cpu_s = 0, faces = 0;
    for (auto _ : state) {
      const BenchTimes times = run_filter(plan.registry, world, filter, nodes);
      state.SetIterationTime(times.wall_s);
      items = static_cast<double>(times.frames) * filter.particles;
      cpu_s += times.cpu_s;
      faces = times.faces_added;
    }
    state.counters["items"] = items;
    state.counters["cpu_s"] = cpu_s;
    state.counters["faces_added"] = faces;
  };
  return c;
}

}  // namespace

void add_frame_cases(const BenchPlan& plan, std::vector<BenchCase>& cases) {
  const int most_threads = plan.threads.back();
  for (int triangles : plan.triangles) {
    const bool large = triangles > kLarge;
    const int particles = large ? plan.particles / 4 : plan.particles;
    for (Maps maps : {Maps::own, Maps::cloned})
      cases.push_back(frame_case(plan, {"update", kFastest, triangles, particles, 1, maps}));
    for (const auto& backend : plan.backends) {
      if (large && backend != kFastest) continue;
      for (int threads : plan.threads)
        cases.push_back(frame_case(plan, {"frame", backend, triangles, particles, threads, Maps::cloned}));
    }
    cases.push_back(frame_case(plan, {"frame", kFastest, triangles, particles, most_threads, Maps::own}));
  }
  for (int n : plan.more_particles)
    cases.push_back(frame_case(plan, {"frame", kFastest, plan.triangles.front(), n, most_threads, Maps::cloned}));
}

}  // namespace ppm
