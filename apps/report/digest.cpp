#include <algorithm>
#include <fmt/core.h>

#include "apps/report/not_done.hpp"
#include "apps/report/outputs.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

/// A cell of a Markdown table.
std::string cell(std::string text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

std::string claims_md(const Analysis& a) {
  if (a.claims.empty()) return "";
  std::string md = "| holds | sequence | claim | number |\n|---|---|---|---|\n";
  for (const auto& c : a.claims)
    md += fmt::format("| {} | {} | {} | {} |\n", to_string(c.holds), c.sequence.empty() ? "all" : cell(c.sequence),
                      cell(c.text), cell(c.number));
  return md + "\n";
}

std::string tallies_md(const Analysis& a) {
  std::string md = "| against | losses | ties | wins | leans to loss | leans to win |\n|---|---|---|---|---|---|\n";
  for (const auto& t : a.tallies)
    md += fmt::format("| {} | {} | {} | {} | {} | {} |\n", cell(a.comparison.graph(t.other).title), t.worse, t.tie,
                      t.better, t.leans_worse, t.leans_better);
  return md + "\n";
}

std::string losses_md(const Analysis& a) {
  std::string md;
  for (const auto& d : a.differences)
    if (d.verdict == Verdict::worse && d.decided())
      md += fmt::format("| {} | {} | {} | {} | {} | {} |\n", cell(d.sequence), cell(a.comparison.graph(d.other).title),
                        heading(*d.measure), shown(*d.measure, d.subject), shown(*d.measure, d.opponent), shown(d));
  if (md.empty()) return "No decided losses.\n\n";
  return "| sequence | against | measure | subject | other | difference |\n|---|---|---|---|---|---|\n" + md + "\n";
}

std::string table_md(const Comparison& c, const SequenceEntry& sequence, const MeasureGroup& group) {
  std::string md = "| graph |", rule = "|---|";
  for (const auto* measure : group.measures) {
    md += fmt::format(" {} |", heading(*measure));
    rule += "---|";
  }
  md += "\n" + rule + "\n";
  for (const auto& graph : c.graphs) {
    const auto runs = c.runs_of(sequence.name, graph.name);
    if (runs.empty()) continue;
    md += fmt::format("| {} |", cell(graph.title));
    for (const auto* measure : group.measures) {
      const auto value = cell_of(runs, *measure);
      md += fmt::format(" {} |", value ? shown(*measure, *value) : "");
    }
    md += "\n";
  }
  return md + "\n";
}

std::string equal_cost_md(const Analysis& a, const SequenceEntry& sequence) {
  std::string md;
  for (const auto& e : a.equal_costs)
    if (e.sequence == sequence.name)
      md +=
          fmt::format("| {} | {} | {} | {} |\n", cell(e.rival), e.cost, shown(e.error_ratio()), shown(e.cost_ratio()));
  return md.empty()
             ? ""
             : "| rival | cost | error's ratio at equal cost | cost's ratio at equal error |\n|---|---|---|---|\n" +
                   md + "\n";
}

std::string failures_md(const Comparison& c) {
  std::string md;
  for (const auto& run : c.runs)
    if (run.status == RunStatus::failed || lost_at_end(run))
      md += fmt::format("- {}, {}, seed {}: {} {}\n", run.sequence, c.graph(run.graph).title, run.seed,
                        lost_at_end(run) ? "lost in the end" : to_string(run.status), cell(run.error));
  if (!md.empty()) md = "Runs that failed or were lost:\n\n" + md + "\n";
  const auto waiting = not_done_sentence(c);
  return waiting.empty() ? md : md + waiting + "\n\n";
}

}  // namespace

std::string digest(const Suite& suite, const std::vector<Analysis>& analyses) {
  std::string md = fmt::format("# {}\n\nppm {}", suite.title, suite.version);
  for (const auto& [key, value] : suite.machine) md += fmt::format("; {}: {}", key, value);
  md += ". Medians over seeds [confidence interval]; `=`: the same for every seed.\n\n";
  for (const auto& a : analyses) {
    const auto& c = a.comparison;
    md += fmt::format("## {}\n\n", c.title) + claims_md(a) +
          fmt::format("{} against the others:\n\n", c.graph(c.subject).title) + tallies_md(a) + losses_md(a) +
          failures_md(c);
    for (const auto& sequence : c.sequences) {
      md += fmt::format("### {}: {}\n\n", c.title, sequence.title);
      for (const auto& group : measure_groups(c, sequence.name)) md += table_md(c, sequence, group);
      md += equal_cost_md(a, sequence);
    }
  }
  return md;
}

}  // namespace ppm::report
