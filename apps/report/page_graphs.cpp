#include <fmt/core.h>

#include "apps/report/config_changes.hpp"
#include "apps/report/html_text.hpp"
#include "apps/report/page_parts.hpp"

namespace ppm::report {

namespace {

/// The composed graph of the first run that has one; runs of one graph differ in the seed alone.
std::string text_of(const Suite& suite, const Comparison& c, const SequenceEntry& sequence, const std::string& graph) {
  for (const auto* run : c.runs_of(sequence.name, graph))
    if (auto text = graph_text(suite, *run); !text.empty()) return text;
  return "";
}

std::string changes_html(const std::string& subject, const std::string& other, const std::string& title) {
  const auto changes = value_changes(graph_values(subject, "subject"), graph_values(other, title));
  if (changes.empty()) return "<p>The same nodes and values as the subject's.</p>\n";
  std::string rows;
  for (const auto& change : changes)
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(change.key), escaped(change.left),
                        escaped(change.right));
  return fmt::format(
      "<div class=\"wide\"><table "
      "class=\"t\"><tr><th>node.key</th><th>subject</th><th>{}</th></tr>\n{}</table></div>\n",
      escaped(title), rows);
}

std::string diff_html(const std::string& subject, const std::string& other) {
  std::string html;
  for (const auto& line : line_diff(subject, other)) {
    const auto text = escaped(fmt::format("{} {}", line.mark, line.text));
    html += line.mark == ' ' ? text + "\n"
                             : fmt::format("<span class=\"{}\">{}</span>", line.mark == '-' ? "minus" : "plus", text);
  }
  return "<details><summary>Line by line against the subject</summary><pre>" + html + "</pre></details>\n";
}

std::string command_text(const std::vector<std::string>& command) {
  std::string text;
  for (const auto& word : command) {
    const bool plain = word.find_first_of(" \t\n'\"\\$&|;<>()*?#[]{}~`!") == std::string::npos && !word.empty();
    text += (text.empty() ? "" : " ");
    if (plain) {
      text += word;
      continue;
    }
    text += "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += "'";
  }
  return text;
}

}  // namespace

std::string graphs_html(const Suite& suite, const Comparison& c, const SequenceEntry& sequence) {
  const auto subject = text_of(suite, c, sequence, c.subject);
  std::string html;
  for (const auto& graph : c.graphs) {
    const auto text = text_of(suite, c, sequence, graph.name);
    if (text.empty()) continue;
    html += fmt::format("<details><summary>{}</summary>\n", escaped(graph.title));
    if (graph.name != c.subject && !subject.empty())
      html += changes_html(subject, text, graph.title) + diff_html(subject, text);
    html += fmt::format("<details{}><summary>The whole graph</summary><pre>{}</pre></details>\n</details>\n",
                        graph.name == c.subject ? " open" : "", escaped(text));
  }
  return html;
}

std::string commands_html(const Comparison& c) {
  std::string text;
  for (const auto& run : c.runs) text += command_text(run.command) + "\n";
  return fmt::format(
      "<details><summary>The command of each run</summary>\n<p>To be given in the suite&#39;s folder. Where a graph "
      "reads data from "
      "${{PPM_DATA}}, that is to be set.</p><pre>{}</pre></details>\n",
      escaped(text));
}

}  // namespace ppm::report
