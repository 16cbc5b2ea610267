#pragma once
#include <string>

#include "apps/report/analysis.hpp"

namespace ppm::report {

/// The page's style sheet: light, for screens of any width and for paper.
const char* page_style();

/// The title of a sequence; "all sequences" for "".
std::string sequence_title(const Comparison& comparison, const std::string& name);

/// What was to be shown; losses, ties and wins of the subject, and their numbers.
std::string summary_html(const Analysis& analysis);
/// Runs that failed or were lost, a line each, and which are still to come; "" where there are none.
std::string failures_html(const Comparison& comparison);
/// Rows graphs, columns measures: a table a group of measures.
std::string tables_html(const Comparison& comparison, const SequenceEntry& sequence);
/// The subject at its rivals' error, memory and time; "" where nothing can be compared.
std::string equal_cost_html(const Analysis& analysis, const SequenceEntry& sequence);
/// Held-out frames as every map shows them, and the final maps: of one seed, in few colours.
std::string pictures_html(const Suite& suite, const Comparison& comparison, const SequenceEntry& sequence);
/// The graphs that ran, and what differs between them and the subject's.
std::string graphs_html(const Suite& suite, const Comparison& comparison, const SequenceEntry& sequence);
/// The command of each run.
std::string commands_html(const Comparison& comparison);

/// "+1.23 mm [0.90, 1.50]": a difference, signed, with its interval.
std::string shown(const Difference& difference);
/// What stands in words beneath every report: how intervals and verdicts come about.
std::string statistics_text();

}  // namespace ppm::report
