#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "apps/report/html_text.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

std::string claims_table(const Analysis& a) {
  if (a.claims.empty()) return "";
  std::string rows;
  for (const auto& c : a.claims)
    rows += fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", to_string(c.holds),
                        to_string(c.holds), escaped(sequence_title(a.comparison, c.sequence)), escaped(c.text),
                        escaped(c.number));
  return "<h3>What was to be shown</h3>\n<p>What does not hold comes first. A claim is open where no graph reaches the "
         "memory, time or error at which it compares, or the seeds are too few.</p>\n"
         "<div class=\"wide\"><table class=\"t\"><tr><th>holds</th><th>sequence</th><th>claim</th>"
         "<th>number (a ratio is the subject's over the other's)</th></tr>\n" +
         rows + "</table></div>\n";
}

std::string tally_table(const Analysis& a) {
  std::string rows;
  for (const auto& t : a.tallies)
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escaped(a.comparison.graph(t.other).title), t.worse, t.tie, t.better, t.leans_worse,
                        t.leans_better);
  return fmt::format(
      "<h3>Losses, ties and wins of {}</h3>\n<p>Over sequences and telling measures, by the confidence interval of the "
      "paired "
      "differences. What only leans one way rests on one run, or on fewer than five seeds.</p>\n"
      "<div class=\"wide\"><table><tr><th>against</th><th>losses</th><th>ties</th><th>wins</th><th>leans to loss</th>"
      "<th>leans to win</th></tr>\n{}</table></div>\n",
      escaped(a.comparison.graph(a.comparison.subject).title), rows);
}

std::string difference_row(const Comparison& c, const Difference& d) {
  const auto level = d.interval ? fmt::format("{:.1f} %", 100 * d.interval->level) : std::string(to_string(d.basis));
  const auto same = std::ranges::count_if(d.differences, [&](double v) { return (v > 0) == (d.median > 0) && v != 0; });
  return fmt::format(
      "<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{} of "
      "{}</td></tr>\n",
      to_string(d.verdict), escaped(sequence_title(c, d.sequence)), escaped(c.graph(d.other).title),
      escaped(heading(*d.measure)), shown(*d.measure, d.subject), shown(*d.measure, d.opponent), shown(d), level, same,
      d.differences.size());
}

std::string difference_rows(const std::string& rows) {
  return "<div "
         "class=\"wide\"><table><tr><th>sequence</th><th>against</th><th>measure</th><th>subject</th><th>other</th>"
         "<th>subject - other</th><th>level</th><th>seeds of that sign</th></tr>\n" +
         rows + "</table></div>\n";
}

/// The differences with one verdict, the worst first; those beyond the first kAtOnce folded away.
std::string differences_table(const Analysis& a, Verdict verdict, const char* title, bool open) {
  constexpr int kAtOnce = 40;
  std::string rows, more;
  int count = 0;
  for (const auto& d : a.differences)
    if (d.verdict == verdict) (count++ < kAtOnce ? rows : more) += difference_row(a.comparison, d);
  if (count == 0) return fmt::format("<p>{}: none.</p>\n", title);
  if (!more.empty())
    more = fmt::format("<details><summary>{} more</summary>\n{}</details>\n", count - kAtOnce, difference_rows(more));
  return fmt::format("<details{}><summary>{}: {}</summary>\n{}{}</details>\n", open ? " open" : "", title, count,
                     difference_rows(rows), more);
}

}  // namespace

std::string shown(const Difference& d) {
  const auto& m = *d.measure;
  auto part = [&](double v) {
    return std::isinf(v) ? std::string(v > 0 ? "+failed" : "-failed") : fmt::format("{:+.{}f}", v, m.digits);
  };
  const auto interval = d.interval ? fmt::format(" [{}, {}]", part(d.interval->low), part(d.interval->high)) : "";
  return part(d.median) + interval;
}

std::string summary_html(const Analysis& a) {
  return claims_table(a) + tally_table(a) + "<h3>Paired differences</h3>\n" +
         differences_table(a, Verdict::worse, "Subject worse", true) +
         differences_table(a, Verdict::tie, "No difference found", false) +
         differences_table(a, Verdict::better, "Subject better", false);
}

std::string statistics_text() {
  return "<p>A cell is the median over the seeds with a confidence interval from order statistics: the narrowest pair "
         "of k-th "
         "smallest and k-th largest value that holds the true median with 95 % probability; with fewer than six seeds "
         "the "
         "smallest and the largest, which hold it with 93.8 % (five seeds), 87.5 % (four), 75 % (three) or 50 % (two). "
         "It assumes no distribution (David and Nagaraja, Order Statistics, 2003, 7.1). &quot;=&quot; marks results "
         "that are the same "
         "for every seed, byte for byte: they do not depend on it.</p>\n"
         "<p>Paired differences are taken run by run, same sequence and same seed; their interval is made the same "
         "way. The subject is "
         "better or worse where that interval leaves zero out at a level of 90 % or more, or where neither result "
         "depends on the "
         "seed, and the digits of the tables show it. Intervals are not corrected for their number: of a hundred "
         "comparisons without any difference some six would "
         "show one.</p>\n"
         "<p>Equal memory, equal time, equal error: a rival's graphs make a front, those that no other of them beats "
         "in cost and "
         "error. Between its points the front is a straight line in the logarithms; it is not continued beyond them. "
         "Where it does not reach, "
         "its end is a bound, and the ratio says &quot;at most&quot; or &quot;at least&quot;.</p>\n"
         "<p>Lines are medians over the seeds, bands the range of all runs that were done.</p>\n";
}

}  // namespace ppm::report
