#include "apps/report/equal_cost.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "apps/report/cells.hpp"
#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

/// y at x on the line through two points, in logarithms.
double between(double x, double x0, double y0, double x1, double y1) {
  const double share = x1 == x0 ? 0.5 : std::log(x / x0) / std::log(x1 / x0);
  return std::exp((1 - share) * std::log(y0) + share * std::log(y1));
}

Reading ratio(double subject, const Reading& rival) {
  const auto flipped = rival.bound == Bound::at_least ? Bound::at_most : Bound::at_least;
  return {subject / rival.value, rival.bound == Bound::exact ? Bound::exact : flipped};
}

/// Kind of a graph's map, "" where no run is done.
std::string map_kind(const Comparison& comparison, const std::string& graph) {
  for (const auto& run : comparison.runs)
    if (const auto kind = run.texts.find("map.kind"); run.graph == graph && kind != run.texts.end())
      return kind->second;
  return "";
}

}  // namespace

std::vector<CostPoint> front_of(std::vector<CostPoint> points) {
  std::ranges::stable_sort(points, {}, [](const CostPoint& p) { return std::tuple(p.cost, p.error); });
  std::vector<CostPoint> front;
  for (auto& point : points)
    if (front.empty() || point.error < front.back().error) front.push_back(std::move(point));
  return front;
}

Reading error_at(const std::vector<CostPoint>& front, double cost) {
  PPM_CHECK(!front.empty(), "a front needs points");
  if (cost < front.front().cost) return {front.front().error, Bound::at_least};
  if (cost > front.back().cost) return {front.back().error, Bound::at_most};
  const auto b = std::ranges::lower_bound(front, cost, {}, &CostPoint::cost);
  if (b->cost == cost) return {b->error, Bound::exact};
  const auto a = b - 1;
  return {between(cost, a->cost, a->error, b->cost, b->error), Bound::exact};
}

Reading cost_at(const std::vector<CostPoint>& front, double error) {
  PPM_CHECK(!front.empty(), "a front needs points");
  if (error > front.front().error) return {front.front().cost, Bound::at_most};
  if (error < front.back().error) return {front.back().cost, Bound::at_least};
  const auto b = std::ranges::lower_bound(front, error, std::greater<>(), &CostPoint::error);
  if (b->error == error) return {b->cost, Bound::exact};
  const auto a = b - 1;
  return {between(error, a->error, a->cost, b->error, b->cost), Bound::exact};
}

Reading EqualCost::error_ratio() const {
  return ratio(subject.error, rival_error);
}

Reading EqualCost::cost_ratio() const {
  return ratio(subject.cost, rival_cost);
}

const char* error_key(const Comparison& comparison) {
  constexpr const char* kOwnPoses = "holdout_estimated.median_mm";
  const bool own = std::ranges::any_of(comparison.runs, [](const Run& run) { return run.numbers.contains(kOwnPoses); });
  return own ? kOwnPoses : "holdout.median_mm";
}

std::optional<CostPoint> cost_point(const Comparison& comparison, const std::string& sequence, const std::string& graph,
                                    const std::string& cost) {
  const auto runs = comparison.runs_of(sequence, graph);
  const auto error = cell_of(runs, measure_of(error_key(comparison)));
  const auto paid = cell_of(runs, measure_of(cost == "memory" ? "map.bytes_owned_total" : "times.cpu_ms_mean"));
  if (!error || !paid) return std::nullopt;
  auto usable = [](double v) { return std::isfinite(v) && v > 0; };
  if (!usable(error->median) || !usable(paid->median)) return std::nullopt;
  return CostPoint{graph, paid->median, error->median};
}

std::string rival_of(const Comparison& comparison, const std::string& graph) {
  const auto kind = map_kind(comparison, graph);
  return kind.empty() || kind == map_kind(comparison, comparison.subject) ? comparison.graph(graph).family : kind;
}

std::vector<EqualCost> equal_costs(const Comparison& comparison) {
  std::vector<EqualCost> all;
  const auto own_family = comparison.graph(comparison.subject).family;
  for (const auto& sequence : comparison.sequences) {
    for (const char* cost : {"memory", "time"}) {
      const auto subject = cost_point(comparison, sequence.name, comparison.subject, cost);
      if (!subject) continue;
      std::set<std::string> seen{own_family};
      for (const auto& graph : comparison.graphs) {
        const auto rival = rival_of(comparison, graph.name);
        if (graph.name == comparison.subject || !seen.insert(rival).second) continue;
        std::vector<CostPoint> points;
        for (const auto& other : comparison.graphs)
          if (other.name != comparison.subject && rival_of(comparison, other.name) == rival)
            if (auto point = cost_point(comparison, sequence.name, other.name, cost)) points.push_back(*point);
        if (points.empty()) continue;
        const auto front = front_of(std::move(points));
        all.push_back({sequence.name, rival, cost, front, *subject, error_at(front, subject->cost),
                       cost_at(front, subject->error)});
      }
    }
  }
  return all;
}

}  // namespace ppm::report
