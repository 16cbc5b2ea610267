#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "apps/report/html_text.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

using Runs = std::vector<const Run*>;

/// The smallest loss of a column: that of the value in bold.
double best_loss(const Comparison& c, const SequenceEntry& sequence, const Measure& measure) {
  double best = INFINITY;
  for (const auto& graph : c.graphs)
    if (const auto cell = cell_of(c.runs_of(sequence.name, graph.name), measure))
      best = std::min(best, loss_of(measure, cell->median));
  return best;
}

std::string cell_html(const Measure& measure, const Runs& runs, double best) {
  const auto cell = cell_of(runs, measure);
  if (!cell) return "<td></td>";
  auto middle = shown(measure, cell->median);
  if (std::isfinite(best) && loss_of(measure, cell->median) == best) middle = "<b>" + middle + "</b>";
  if (cell->seed_free) return fmt::format("<td>{}<small>=</small></td>", middle);
  if (!cell->interval) return fmt::format("<td>{}</td>", middle);
  return fmt::format("<td>{}<small>{} .. {}</small></td>", middle, shown(measure, cell->interval->low),
                     shown(measure, cell->interval->high));
}

std::string runs_text(const Runs& runs) {
  const auto o = outcome_of(runs);
  auto text = fmt::format("{} done", o.done);
  if (o.failed) text += fmt::format(", {} failed", o.failed);
  if (o.lost) text += fmt::format(", {} lost", o.lost);
  if (o.waiting) text += fmt::format(", {} to come", o.waiting);
  return text;
}

std::string table_html(const Comparison& c, const SequenceEntry& sequence, const MeasureGroup& group) {
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"cells\"><caption>{}</caption>\n<tr><th>graph</th><th>runs</th>", group.title);
  for (const auto* measure : group.measures) html += fmt::format("<th>{}</th>", escaped(heading(*measure)));
  html += "</tr>\n";
  for (const auto& graph : c.graphs) {
    const auto runs = c.runs_of(sequence.name, graph.name);
    if (runs.empty()) continue;
    html += fmt::format("<tr{}><td>{}</td><td>{}</td>", graph.name == c.subject ? " class=\"subject\"" : "",
                        escaped(graph.title), runs_text(runs));
    for (const auto* measure : group.measures) html += cell_html(*measure, runs, best_loss(c, sequence, *measure));
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string amount(const EqualCost& e, double value) {
  return fmt::format("{:.3g} {}", value, e.cost == "memory" ? "MiB" : "ms");
}

std::string bounded(const Reading& reading, const std::string& text) {
  return (reading.bound == Bound::exact ? "" : reading.bound == Bound::at_most ? "at most " : "at least ") + text;
}

}  // namespace

std::string tables_html(const Comparison& c, const SequenceEntry& sequence) {
  std::string html;
  for (const auto& group : measure_groups(c, sequence.name)) html += table_html(c, sequence, group);
  return html;
}

std::string equal_cost_html(const Analysis& a, const SequenceEntry& sequence) {
  std::string rows;
  for (const auto& e : a.equal_costs) {
    if (e.sequence != sequence.name) continue;
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.2f} mm</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(e.rival), e.cost, amount(e, e.subject.cost), e.subject.error,
        bounded(e.rival_error, fmt::format("{:.2f} mm", e.rival_error.value)), shown(e.error_ratio()),
        bounded(e.rival_cost, amount(e, e.rival_cost.value)), shown(e.cost_ratio()));
  }
  if (rows.empty()) return "";
  return "<div class=\"wide\"><table><caption>At equal cost and at equal "
         "error</caption>\n<tr><th>rival</th><th>cost</th>"
         "<th>subject's cost</th><th>subject's error</th><th>rival's error at that cost</th><th>ratio of errors</th>"
         "<th>rival's cost at that error</th><th>ratio of costs</th></tr>\n" +
         rows + "</table></div>\n";
}

}  // namespace ppm::report
