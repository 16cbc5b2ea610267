#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/bench_world.hpp"

namespace benchmark {
class State;
}

namespace ppm {

/// One thing to be timed.
struct BenchCase {
  std::string group;                                          ///< "view"
  std::vector<std::pair<std::string, std::string>> settings;  ///< in the order of the name
  std::string item;                                           ///< what the time is of: "view", "particle and frame"
  /// Sets the time of each iteration, and the counters "items" (in an iteration) and "cpu_s" (of the process, over all
  /// iterations). Throws what the modules throw: the case is then reported as left out, with the reason.
  std::function<void(benchmark::State&)> run;

  /// "view/prediction.embree/triangles:20000".
  std::string name() const;
};

/// What the sizes of the cases are.
struct BenchPlan {
  const Registry& registry;
  BenchWorlds& worlds;
  std::vector<std::string> backends = {};  ///< every prediction.* for mesh maps
  std::vector<std::string> exact = {};     ///< those whose views a map update can use
  std::vector<int> triangles = {};
  int cols = 176;             ///< of the camera
  int particles = 32;         ///< where their number does not vary
  int many_particles = 1000;  ///< that share what they can
  std::vector<int> more_particles = {}, more_cols = {}, strides = {}, threads = {};
  bool quick = false;
};
BenchPlan full_plan(const Registry& registry, BenchWorlds& worlds, int threads);
BenchPlan quick_plan(const Registry& registry, BenchWorlds& worlds, int threads);

// bench_views.cpp, bench_frames.cpp, bench_maps.cpp, bench_roofs.cpp: what each has of the plan.
void add_view_cases(const BenchPlan& plan, std::vector<BenchCase>& cases);
void add_frame_cases(const BenchPlan& plan, std::vector<BenchCase>& cases);
void add_map_cases(const BenchPlan& plan, std::vector<BenchCase>& cases);
void add_roof_cases(const BenchPlan& plan, std::vector<BenchCase>& cases);
std::vector<BenchCase> cases_of(const BenchPlan& plan);

}  // namespace ppm
