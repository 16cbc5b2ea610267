#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "framework/graph/describe.hpp"
#include "framework/graph/facet_state.hpp"

namespace ppm {

namespace {

std::string gate_text(const Gate& gate) {
  std::vector<std::string> words;
  const Config when = gate.effective();
  for (const auto& entry : when.entries()) words.push_back(fmt::format("{} {}", entry.key, entry.value.text()));
  return gate.at_end ? "at end" : fmt::format("{}", fmt::join(words, ", "));
}

std::string inputs_text(const Node& node) {
  std::vector<std::string> words;
  for (const auto& edge : node.edges) words.push_back(edge.port + " <- " + edge.from);
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? "\\n" : std::string(1, c);
  }
  return out + '"';
}

bool uses_belief(const Node& node) {
  return std::ranges::any_of(node.module->ports(), [](auto* p) { return p->direction() == PortDirection::belief; });
}

}  // namespace

std::string graph_text(const Graph& graph) {
  using Row = std::array<std::string, 5>;
  std::vector<Row> rows{{"node", "module", "inputs", "when", "belief after it"}};
  FacetState state;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const Node& node = graph.nodes()[i];
    state.pass(facets_of(*node.module), i, 0);
    const auto belief = uses_belief(node) ? fmt::format("{}", fmt::join(state.words(), ", ")) : "";
    rows.push_back({node.name, node.module_name, inputs_text(node), gate_text(node.gate), belief});
  }
  Row::size_type columns = rows.front().size();
  std::vector<std::size_t> widths(columns);
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < columns; ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string out = fmt::format("{} (seed {})\n", graph.name(), graph.seed());
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < columns; ++k) line += fmt::format("{:<{}}  ", row[k], widths[k]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string graph_dot(const Graph& graph) {
  std::string out =
      fmt::format("digraph {} {{\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n", quoted(graph.name()));
  const Node* last = nullptr;
  for (const auto& node : graph.nodes()) {
    const auto when = gate_text(node.gate);
    const auto label = node.name + "\n" + node.module_name + (when.empty() ? "" : "\n" + when);
    out += fmt::format("  {} [label={}{}];\n", quoted(node.name), quoted(label), when.empty() ? "" : ", style=dashed");
    for (const auto& edge : node.edges) {
      const auto dot = edge.from.find('.');
      const bool use = dot == std::string::npos;
      out += fmt::format("  {} -> {} [label={}{}];\n", quoted(edge.from.substr(0, dot)), quoted(node.name),
                         quoted(use ? edge.port : edge.from.substr(dot + 1)), use ? ", style=dotted" : "");
    }
    if (!uses_belief(node)) continue;
    if (last) out += fmt::format("  {} -> {} [label=\"belief\", style=bold];\n", quoted(last->name), quoted(node.name));
    last = &node;
  }
  return out + "}\n";
}

}  // namespace ppm
