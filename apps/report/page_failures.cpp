#include <algorithm>
#include <fmt/core.h>

#include "apps/report/html_text.hpp"
#include "apps/report/not_done.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

std::string row(const Comparison& c, const std::string& sequence, const std::string& graph, const std::string& seeds,
                const char* status, const std::string& why) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escaped(sequence_title(c, sequence)), escaped(c.graph(graph).title), seeds, status, escaped(why));
}

std::string table(const std::string& rows) {
  return "<div class=\"wide\"><table class=\"t\"><tr><th>sequence</th><th>graph</th><th>seed</th><th>status</th>"
         "<th>why</th></tr>\n" +
         rows + "</table></div>\n";
}

}  // namespace

std::string sequence_title(const Comparison& c, const std::string& name) {
  const auto found = std::ranges::find(c.sequences, name, &SequenceEntry::name);
  return found == c.sequences.end() ? name.empty() ? "all sequences" : name : found->title;
}

std::string failures_html(const Comparison& c) {
  constexpr std::size_t kAtOnce = 10;
  std::string failed, waiting;
  for (const auto& run : c.runs)
    if (run.status == RunStatus::failed || lost_at_end(run))
      failed += row(c, run.sequence, run.graph, fmt::format("{}", run.seed),
                    lost_at_end(run) ? "lost in the end" : to_string(run.status), run.error);
  const auto parts = not_done(c);
  for (const auto& part : parts)
    waiting += row(c, part.sequence, part.graph, seeds_text(part.seeds), to_string(part.status), "");
  if (failed.empty() && waiting.empty()) return "";
  std::string html =
      "<h3>Runs that failed, were lost or are not done</h3>\n<p>A run that failed counts as worse than any other in "
      "every measure. Runs that are not done count nowhere.</p>\n";
  if (parts.size() <= kAtOnce) return html + table(failed + waiting);
  if (!failed.empty()) html += table(failed);
  return html +
         fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(not_done_sentence(c)), table(waiting));
}

}  // namespace ppm::report
