#include "framework/graph/override.hpp"

#include "framework/graph/graph_builder.hpp"

namespace ppm {

Override parse_override(const std::string& text) {
  const std::string name = "--set " + text;
  const auto equals = text.find('=');
  const auto dot = text.find('.');
  if (equals == std::string::npos) throw ConfigError({name, 0, 0}, "write node.key=value");
  Override result;
  const bool of_node = dot < equals;
  if (of_node) result.node = text.substr(0, dot);
  const auto key_begin = of_node ? dot + 1 : 0;
  result.key = text.substr(key_begin, equals - key_begin);
  if (result.key.empty() || (of_node && result.node.empty())) throw ConfigError({name, 0, 0}, "write node.key=value");
  // Blanks in place of "node.key=" make the columns those of the whole text.
  result.value = parse_yaml(std::string(equals + 1, ' ') + text.substr(equals + 1), name);
  return result;
}

namespace {

/// The node of that name, or null after a report.
Config* find_node(Config& nodes, const Override& o, Diagnostics& mistakes) {
  std::vector<std::string> names;
  for (auto& node : nodes.items()) {
    const Config* name = node.kind() == Config::Kind::map ? node.find("name") : nullptr;
    if (!name) continue;
    if (name->text() == o.node) return &node;
    names.push_back(name->text());
  }
  mistakes.push_back({o.value.place(), fmt::format("no node '{}'{}", o.node, suggestion(o.node, names))});
  return nullptr;
}

}  // namespace

void apply_overrides(const std::vector<Override>& overrides, Config& file, Diagnostics& mistakes) {
  for (const auto& o : overrides) {
    if (o.node.empty()) {
      file.set(o.key, o.value.place(), o.value);
      continue;
    }
    Config* nodes = file.find("nodes");
    Config* node = nodes ? find_node(*nodes, o, mistakes) : nullptr;
    if (!node) continue;
    if (!node->find("params")) node->set("params", o.value.place(), Config());
    Config& params = *node->find("params");
    const bool settable = params.kind() == Config::Kind::map || params.kind() == Config::Kind::null;
    if (settable) params.set(o.key, o.value.place(), o.value);  // else reading the node says what is wrong
  }
}

}  // namespace ppm
