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

void GraphBuilder::override_tree(Config& file, const std::vector<Override>& overrides) {
  for (const auto& o : overrides) {
    if (o.node.empty()) {
      file.set(o.key, o.value.place(), o.value);
      continue;
    }
    Config* nodes = file.find("nodes");
    if (!nodes) continue;
    std::vector<std::string> names;
    Config* found = nullptr;
    for (auto& node : nodes->items()) {
      const Config* name = node.kind() == Config::Kind::map ? node.find("name") : nullptr;
      if (!name) continue;
      names.push_back(name->text());
      if (name->text() == o.node && !found) found = &node;
    }
    if (!found) {
      report(o.value.place(), fmt::format("no node '{}'{}", o.node, suggestion(o.node, names)));
      continue;
    }
    if (!found->find("params")) found->set("params", o.value.place(), Config());
    Config& params = *found->find("params");
    const bool settable = params.kind() == Config::Kind::map || params.kind() == Config::Kind::null;
    if (settable) params.set(o.key, o.value.place(), o.value);  // else reading the node says what is wrong
  }
}

}  // namespace ppm
