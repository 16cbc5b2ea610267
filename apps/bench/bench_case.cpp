#include "apps/bench/bench_case.hpp"

#include <algorithm>
#include <cctype>

namespace ppm {
namespace {

/// The prediction.* that name a facet among what they need, or give.
std::vector<std::string> predictors(const Registry& registry, std::vector<std::string> Facets::*words,
                                    const std::string& facet) {
  std::vector<std::string> names;
  for (const ModuleInfo* info : registry.all()) {
    if (!info->name.starts_with("prediction.")) continue;
    const auto module = info->make();
    for (const PortBase* port : module->ports()) {
      if (port->direction() != PortDirection::belief) continue;
      const auto& named = static_cast<const BeliefPortBase*>(port)->facets().*words;
      if (std::ranges::find(named, facet) != named.end()) names.push_back(info->name);
    }
  }
  return names;
}

BenchPlan plan_of(const Registry& registry, BenchWorlds& worlds) {
  return {registry, worlds, predictors(registry, &Facets::needs, "map.ppm"),
          predictors(registry, &Facets::gives, "prediction.elements")};
}

}  // namespace

std::string BenchCase::name() const {
  std::string text = group;
  for (const auto& [key, value] : settings) {
    const bool word = !std::isdigit(static_cast<unsigned char>(value.front()));
    text += "/" + (word ? value : key + ":" + value);
  }
  return text;
}

BenchPlan full_plan(const Registry& registry, BenchWorlds& worlds, int threads) {
  BenchPlan plan = plan_of(registry, worlds);
  plan.triangles = {20000, 100000, 500000};
  plan.more_particles = {8, 128};
  plan.more_cols = {88, 352};
  plan.strides = {2, 4, 8, 16};
  for (int n = 1; n < threads; n *= 2) plan.threads.push_back(n);
  plan.threads.push_back(threads);
  return plan;
}

BenchPlan quick_plan(const Registry& registry, BenchWorlds& worlds, int threads) {
  BenchPlan plan = plan_of(registry, worlds);
  plan.triangles = {5000};
  plan.cols = 44;
  plan.particles = 4;
  plan.many_particles = 20;
  plan.strides = {4};
  if (threads > 1) plan.threads.push_back(1);
  plan.threads.push_back(threads);
  plan.quick = true;
  return plan;
}

std::vector<BenchCase> cases_of(const BenchPlan& plan) {
  std::vector<BenchCase> cases;
  add_roof_cases(plan, cases);
  add_view_cases(plan, cases);
  add_frame_cases(plan, cases);
  add_map_cases(plan, cases);
  return cases;
}

}  // namespace ppm
