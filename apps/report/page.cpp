#include <fmt/core.h>

#include "apps/report/html_text.hpp"
#include "apps/report/outputs.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

std::string machine_html(const Suite& suite) {
  std::string text = fmt::format("ppm {}", escaped(suite.version));
  for (const auto& [key, value] : suite.machine) text += fmt::format("; {}: {}", escaped(key), escaped(value));
  return "<p>" + text + "</p>\n";
}

std::string contents_html(const Suite& suite) {
  std::string items;
  for (const auto& c : suite.comparisons) {
    items += fmt::format("<li><a href=\"#{0}\">{1}</a>: ", escaped(c.name), escaped(c.title));
    for (const auto& s : c.sequences)
      items += fmt::format(" <a href=\"#{}-{}\">{}</a>", escaped(c.name), escaped(s.name), escaped(s.title));
    items += "</li>\n";
  }
  return "<ul>\n" + items + "<li><a href=\"#statistics\">How the numbers are made</a></li>\n</ul>\n";
}

std::string head_html(const Comparison& c) {
  const auto o = [&] {
    std::vector<const Run*> all;
    for (const auto& run : c.runs) all.push_back(&run);
    return outcome_of(all);
  }();
  std::string html = fmt::format("<h2 id=\"{}\">{}</h2>\n<p>Subject: <b>{}</b>", escaped(c.name), escaped(c.title),
                                 escaped(c.graph(c.subject).title));
  if (!c.against.empty()) html += fmt::format(", first of all against <b>{}</b>", escaped(c.graph(c.against).title));
  return html + fmt::format(". {} graphs, {} sequences; {} runs done, {} failed, {} lost in the end, {} to come.</p>\n",
                            c.graphs.size(), c.sequences.size(), o.done, o.failed, o.lost, o.waiting);
}

std::string sequence_html(const Suite& suite, const Analysis& a, const SequenceEntry& sequence,
                          const std::vector<Plot>& plots) {
  const auto& c = a.comparison;
  std::string html = fmt::format("<h3 id=\"{}-{}\">{}: {}</h3>\n", escaped(c.name), escaped(sequence.name),
                                 escaped(c.title), escaped(sequence.title));
  html += tables_html(c, sequence) + equal_cost_html(a, sequence) + "<div class=\"plots\">\n";
  for (const auto& plot : plots) html += "<figure>" + svg_plot(plot) + "</figure>\n";
  return html + "</div>\n" + pictures_html(suite, c, sequence) + "<h4>Graphs</h4>\n" + graphs_html(suite, c, sequence);
}

std::string comparison_html(const Suite& suite, const Analysis& a) {
  std::string html = head_html(a.comparison) + summary_html(a) + failures_html(a.comparison);
  for (const auto& [sequence, plots] : a.plots) html += sequence_html(suite, a, *sequence, plots);
  return html + commands_html(a.comparison);
}

}  // namespace

std::string page(const Suite& suite, const std::vector<Analysis>& analyses) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<title>{}</title>\n<style>{}</style></head>\n"
      "<body>\n<h1>{}</h1>\n",
      escaped(suite.title), page_style(), escaped(suite.title));
  html += machine_html(suite) + contents_html(suite);
  for (const auto& a : analyses) html += comparison_html(suite, a);
  html += "<h2 id=\"statistics\">How the numbers are made</h2>\n" + statistics_text();
  html += fmt::format("<h2>The suite</h2>\n<details><summary>{}</summary><pre>{}</pre></details>\n</body></html>\n",
                      escaped(suite.file), escaped(suite.text));
  return html;
}

}  // namespace ppm::report
