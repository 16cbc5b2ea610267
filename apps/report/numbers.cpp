#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/report/outputs.hpp"
#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json list(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double v : values) json.push_back(number(v));
  return json;
}

Json interval_json(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return {{"low", number(interval->low)}, {"high", number(interval->high)}, {"level", interval->level}};
}

const char* bound_text(Bound bound) {
  return bound == Bound::at_most ? "at most" : bound == Bound::at_least ? "at least" : "exact";
}

Json reading_json(const Reading& reading) {
  return {{"value", number(reading.value)}, {"bound", bound_text(reading.bound)}};
}

Json point_json(const CostPoint& point) {
  return {{"graph", point.graph}, {"cost", point.cost}, {"error", point.error}};
}

Json claims_json(const Analysis& a) {
  Json json = Json::array();
  for (const auto& c : a.claims)
    json.push_back({{"sequence", c.sequence}, {"claim", c.text}, {"number", c.number}, {"holds", to_string(c.holds)}});
  return json;
}

Json tallies_json(const Analysis& a) {
  Json json = Json::array();
  for (const auto& t : a.tallies)
    json.push_back({{"other", t.other},
                    {"worse", t.worse},
                    {"tie", t.tie},
                    {"better", t.better},
                    {"leans_worse", t.leans_worse},
                    {"leans_better", t.leans_better}});
  return json;
}

Json differences_json(const Analysis& a) {
  Json json = Json::array();
  for (const auto& d : a.differences)
    json.push_back({{"sequence", d.sequence},
                    {"other", d.other},
                    {"measure", d.measure->key},
                    {"unit", d.measure->unit},
                    {"verdict", to_string(d.verdict)},
                    {"basis", to_string(d.basis)},
                    {"subject", number(d.subject)},
                    {"opponent", number(d.opponent)},
                    {"differences", list(d.differences)},
                    {"median", number(d.median)},
                    {"interval", interval_json(d.interval)},
                    {"sign_test_p", d.p}});
  return json;
}

Json equal_costs_json(const Analysis& a) {
  Json json = Json::array();
  for (const auto& e : a.equal_costs) {
    Json front = Json::array();
    for (const auto& point : e.front) front.push_back(point_json(point));
    json.push_back({{"sequence", e.sequence},
                    {"rival", e.rival},
                    {"cost", e.cost},
                    {"subject", point_json(e.subject)},
                    {"front", front},
                    {"rival_error", reading_json(e.rival_error)},
                    {"error_ratio", reading_json(e.error_ratio())},
                    {"rival_cost", reading_json(e.rival_cost)},
                    {"cost_ratio", reading_json(e.cost_ratio())}});
  }
  return json;
}

Json measures_json(const Comparison& c, const SequenceEntry& sequence, const std::vector<const Run*>& runs) {
  Json json = Json::object();
  for (const auto& group : measure_groups(c, sequence.name)) {
    for (const auto* measure : group.measures) {
      const auto cell = cell_of(runs, *measure);
      if (!cell) continue;
      json[measure->key] = {{"unit", measure->unit},
                            {"values", list(cell->values)},
                            {"median", number(cell->median)},
                            {"interval", interval_json(cell->interval)},
                            {"seed_changes_nothing", cell->seed_free}};
    }
  }
  return json;
}

Json results_json(const Comparison& c) {
  Json json = Json::array();
  for (const auto& sequence : c.sequences) {
    for (const auto& graph : c.graphs) {
      const auto runs = c.runs_of(sequence.name, graph.name);
      if (runs.empty()) continue;
      const auto o = outcome_of(runs);
      json.push_back(
          {{"sequence", sequence.name},
           {"graph", graph.name},
           {"runs", {{"done", o.done}, {"failed", o.failed}, {"waiting", o.waiting}, {"lost_at_end", o.lost}}},
           {"measures", measures_json(c, sequence, runs)}});
    }
  }
  return json;
}

Json plots_json(const Analysis& a) {
  Json json = Json::array();
  for (const auto& [sequence, plots] : a.plots) {
    for (const auto& plot : plots) {
      Json series = Json::array();
      for (const auto& s : plot.series)
        series.push_back(
            {{"label", s.label}, {"x", list(s.x)}, {"y", list(s.y)}, {"low", list(s.low)}, {"high", list(s.high)}});
      json.push_back({{"sequence", sequence->name},
                      {"title", plot.title},
                      {"x", plot.x_label},
                      {"y", plot.y_label},
                      {"series", series}});
    }
  }
  return json;
}

Json graphs_json(const Comparison& c) {
  Json json = Json::array();
  for (const auto& graph : c.graphs)
    json.push_back({{"name", graph.name}, {"title", graph.title}, {"family", graph.family}, {"sweep", graph.sweep}});
  return json;
}

Json runs_json(const Comparison& c) {
  Json json = Json::array();
  for (const auto& run : c.runs)
    json.push_back({{"sequence", run.sequence},
                    {"graph", run.graph},
                    {"seed", run.seed},
                    {"status", to_string(run.status)},
                    {"folder", run.folder.generic_string()},
                    {"command", run.command},
                    {"error", run.error}});
  return json;
}

}  // namespace

std::string numbers(const Suite& suite, const std::vector<Analysis>& analyses) {
  Json comparisons = Json::array();
  for (const auto& a : analyses) {
    const auto& c = a.comparison;
    comparisons.push_back({{"name", c.name},
                           {"title", c.title},
                           {"subject", c.subject},
                           {"against", c.against},
                           {"graphs", graphs_json(c)},
                           {"claims", claims_json(a)},
                           {"tallies", tallies_json(a)},
                           {"differences", differences_json(a)},
                           {"equal_cost", equal_costs_json(a)},
                           {"results", results_json(c)},
                           {"plots", plots_json(a)},
                           {"runs", runs_json(c)}});
  }
  Json machine = Json::object();
  for (const auto& [key, value] : suite.machine) machine[key] = value;
  const Json json = {{"name", suite.name},       {"title", suite.title}, {"suite_file", suite.file},
                     {"version", suite.version}, {"machine", machine},   {"comparisons", comparisons}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ppm::report
