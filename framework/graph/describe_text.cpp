#include <algorithm>
#include <fmt/format.h>

#include "framework/graph/describe.hpp"
#include "framework/graph/facet_state.hpp"
#include "framework/graph/param_text.hpp"

namespace ppm {

namespace {

/// Breaks a text into lines of at most `width` characters, the second and later ones indented.
std::string wrap(const std::string& text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t column = 0, begin = 0;
  while (begin < text.size()) {
    const auto end = std::min(text.find(' ', begin), text.size());
    const auto length = end - begin;
    if (column > 0 && column + 1 + length > width) {
      out += "\n" + std::string(indent, ' ');
      column = 0;
    }
    if (column > 0) out += ' ';
    out += text.substr(begin, length);
    column += length + (column > 0);
    begin = end + 1;
  }
  return out;
}

/// Rows of cells as aligned columns; the last one is wrapped.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t kLine = 120, kLeast = 40;
  std::vector<std::size_t> widths(rows.front().size() - 1);
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < widths.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::size_t indent = 2;
  for (auto width : widths) indent += width + 2;
  std::string out;
  for (const auto& row : rows) {
    out += "  ";
    for (std::size_t k = 0; k < widths.size(); ++k) out += fmt::format("{:<{}}  ", row[k], widths[k]);
    out += wrap(row.back(), std::max(kLeast, kLine - std::min(kLine, indent)), indent) + "\n";
  }
  return out;
}

std::string ports_text(const Module& module, PortDirection direction, const std::string& title) {
  std::vector<std::vector<std::string>> rows;
  for (const auto* port : module.ports()) {
    if (port->direction() == direction) rows.push_back({port->name(), std::string(port->type_name()), port->doc()});
  }
  return rows.empty() ? "" : "\n" + title + "\n" + table(rows);
}

std::string belief_text(const Module& module) {
  const auto facets = facets_of(module);
  std::string out;
  for (const auto* port : module.ports()) {
    if (port->direction() == PortDirection::belief) out = "\nbelief\n  " + port->doc() + "\n";
  }
  auto words = [&](const char* what, const std::vector<std::string>& list) {
    if (!list.empty()) out += fmt::format("  {:<6}{}\n", what, fmt::join(list, ", "));
  };
  words("needs", facets.needs);
  words("gives", facets.gives);
  words("drops", facets.drops);
  return out;
}

}  // namespace

std::string describe_text(const ModuleInfo& info) {
  const auto module = info.make();
  std::string out =
      fmt::format("{}\n  {}\n  source: {}\n  from:   {}\n", info.name, info.summary, info.source, info.origin);
  out += ports_text(*module, PortDirection::in, "inputs");
  out += ports_text(*module, PortDirection::use, "calls nodes");
  out += ports_text(*module, PortDirection::out, "outputs");
  out += belief_text(*module);
  std::vector<std::vector<std::string>> rows;
  for (const auto& spec : module->params().specs()) {
    rows.push_back({spec.name(), type_text(spec), default_text(spec), allowed_text(spec), spec.doc()});
  }
  if (!rows.empty()) out += "\nparameters\n" + table(rows);
  return out;
}

}  // namespace ppm
