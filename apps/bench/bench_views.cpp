// What views cost, alone and with a likelihood: one map, each view at a pose of its own, one thread.
#include <benchmark/benchmark.h>

#include "apps/bench/bench_case.hpp"
#include "apps/bench/bench_filter.hpp"

namespace ppm {
namespace {

struct ViewSetup {
  std::string group, backend;
  int triangles, cols, stride;
  std::string weigh, weigh_params;  // "" : the view alone
};

BenchCase view_case(const BenchPlan& plan, const ViewSetup& s) {
  BenchCase c;
  c.group = s.group;
  c.item = s.weigh.empty() || s.weigh == "weighting.bench_fill" ? "view" : "particle";
  c.settings = {{"backend", s.backend}};
  if (s.group == "weigh") c.settings.emplace_back("weighting", s.weigh);
  c.settings.emplace_back("triangles", std::to_string(s.triangles));
  if (s.cols != plan.cols) c.settings.emplace_back("cols", std::to_string(s.cols));
  if (s.stride != 1) c.settings.emplace_back("stride", std::to_string(s.stride));
  c.run = [&plan, s](benchmark::State& state) {
    BenchWorld& world = plan.worlds.of(s.triangles, s.cols);
    BenchFilter filter;
    filter.particles = plan.particles;
    filter.look = s.backend;
    filter.look_params = fmt::format("{{stride: {}}}", s.stride);
    filter.weigh = s.weigh;
    filter.weigh_params = s.weigh_params;
    std::vector<std::string> nodes{"look"};
    if (!s.weigh.empty()) nodes.push_back("weigh");
    double items = 0, cpu_s = 0;
    for (auto _ : state) {
      const BenchTimes times = run_filter(plan.registry, world, filter, nodes);
      state.SetIterationTime(times.wall_s);
      items = static_cast<double>(times.frames) * filter.particles;
      cpu_s += times.cpu_s;
    }
    const Camera camera = world.frames.front()->camera.decimated(s.stride);
    state.counters["items"] = items;
    state.counters["cpu_s"] = cpu_s;
    state.counters["rays"] = camera.pixels();
  };
  return c;
}

constexpr const char* kAllPixels = "{pixels: 0}";

}  // namespace

void add_view_cases(const BenchPlan& plan, std::vector<BenchCase>& cases) {
  for (const auto& backend : plan.backends) {
    for (int triangles : plan.triangles) {
      cases.push_back(view_case(plan, {"view", backend, triangles, plan.cols, 1, "", "{}"}));
      cases.push_back(view_case(plan, {"view_filled", backend, triangles, plan.cols, 1, "weighting.bench_fill", "{}"}));
      for (int stride : plan.strides)
        cases.push_back(view_case(plan, {"view", backend, triangles, plan.cols, stride, "", "{}"}));
      for (const char* weighting : {"weighting.gaussian", "weighting.robust"})
        cases.push_back(view_case(plan, {"weigh", backend, triangles, plan.cols, 1, weighting, kAllPixels}));
    }
    for (int cols : plan.more_cols)
      cases.push_back(view_case(plan, {"view", backend, plan.triangles.front(), cols, 1, "", "{}"}));
  }
}

}  // namespace ppm
