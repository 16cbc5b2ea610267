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
  shared,  ///< all start with one
};
/// What the map update does.
enum class Update {
  full,    ///< all, in every frame
  texels,  ///< all in each sixth frame, in the others texels alone
  alone,   ///< texels alone, in every frame: the map explains what is seen
  sparse,  ///< all in each sixth frame, nothing in the others
};

struct FrameSetup {
  std::string group, backend;
  int triangles, particles, threads;
  Maps maps;
  Update update;
  int pixels = 0;  // compared, where particles share maps: 0 = all
};

std::string name_of(Maps maps) {
  return maps == Maps::own ? "own" : maps == Maps::cloned ? "cloned" : "shared";
}
std::string name_of(Update update) {
  switch (update) {
    case Update::full:
      return "full";
    case Update::texels:
      return "keyframes_and_texels";
    case Update::alone:
      return "texels";
    default:
      return "keyframes";
  }
}

BenchFilter filter_of(const FrameSetup& s) {
  BenchFilter filter;
  filter.particles = s.particles;
  filter.threads = s.threads;
  filter.own_maps = s.maps != Maps::shared;
  filter.clones = s.maps == Maps::cloned;
  filter.jitter = kJitter;
  filter.look = s.backend;
  filter.weigh = "weighting.robust";
  filter.weigh_params = s.maps == Maps::shared ? fmt::format("{{pixels: {}}}", s.pixels) : kFlatWeights;
  filter.ess_below = 0.5;
  filter.update = "map_update.ppm_bayes";
  if (s.update == Update::alone) filter.update_params = "{keyframe_every: 1000000, between: texels}";
  if (s.update == Update::texels) filter.update_params = "{keyframe_every: 6, between: texels}";
  if (s.update == Update::sparse) filter.view = kFastest, filter.update_every = 6;
  return filter;
}

BenchCase frame_case(const BenchPlan& plan, const FrameSetup& s) {
  BenchCase c;
  c.group = s.group;
  c.item = "particle and frame";
  c.settings = {{"backend", s.backend},
                {"maps", name_of(s.maps)},
                {"update", name_of(s.update)},
                {"triangles", std::to_string(s.triangles)},
                {"particles", std::to_string(s.particles)},
                {"threads", std::to_string(s.threads)}};
  if (s.maps == Maps::shared) c.settings.emplace_back("pixels", std::to_string(s.pixels));
  c.run = [&plan, s](benchmark::State& state) {
    BenchWorld& world = plan.worlds.of(s.triangles, plan.cols);
    const BenchFilter filter = filter_of(s);
    const std::vector<std::string> nodes = s.group == "update"
                                               ? std::vector<std::string>{"update"}
                                               : std::vector<std::string>{"look", "weigh", "pick", "view", "update"};
    BenchTimes times;
    double cpu_s = 0;
    for (auto _ : state) {
      times = run_filter(plan.registry, world, filter, nodes);
      state.SetIterationTime(times.wall_s);
      cpu_s += times.cpu_s;
    }
    state.counters["items"] = static_cast<double>(times.frames) * filter.particles;
    state.counters["cpu_s"] = cpu_s;
    state.counters["faces_added"] = times.faces_added;
    if (s.maps == Maps::shared) state.counters["ancestors"] = times.ancestors;
  };
  return c;
}

void add_cases_of(const BenchPlan& plan, int triangles, std::vector<BenchCase>& cases) {
  const int particles = triangles > kLarge ? plan.particles / 4 : plan.particles;
  const int most_threads = plan.threads.back();
  const auto add = [&](const std::string& group, const std::string& backend, int threads, Maps maps, Update update) {
    cases.push_back(frame_case(plan, {group, backend, triangles, particles, threads, maps, update}));
  };
  for (Maps maps : {Maps::own, Maps::cloned})
    for (Update update : {Update::full, Update::texels, Update::alone}) add("update", kFastest, 1, maps, update);
  for (const auto& backend : plan.exact) {
    if (triangles > kLarge && backend != kFastest) continue;
    for (int threads : plan.threads) add("frame", backend, threads, Maps::cloned, Update::texels);
  }
  add("frame", kFastest, most_threads, Maps::own, Update::texels);
  for (Maps maps : {Maps::own, Maps::cloned})
    for (int threads : plan.threads) add("frame", kFastest, threads, maps, Update::alone);
  add("frame", kFastest, most_threads, Maps::cloned, Update::full);
}

}  // namespace

void add_frame_cases(const BenchPlan& plan, std::vector<BenchCase>& cases) {
  for (int triangles : plan.triangles) add_cases_of(plan, triangles, cases);
  const int most_threads = plan.threads.back();
  for (int n : plan.more_particles)
    cases.push_back(
        frame_case(plan, {"frame", kFastest, plan.triangles.front(), n, most_threads, Maps::cloned, Update::texels}));
  for (const std::string backend : {kFastest, "prediction.shared_view"})
    for (int pixels : {0, 1200})
      cases.push_back(frame_case(plan, {"frame", backend, plan.triangles.front(), plan.many_particles, most_threads,
                                        Maps::shared, Update::sparse, pixels}));
}

}  // namespace ppm
