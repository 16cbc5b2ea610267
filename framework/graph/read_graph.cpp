#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <regex>
#include <tuple>

#include "framework/graph/graph_builder.hpp"
#include "framework/graph/override.hpp"
#include "framework/graph/shipped_plugins.hpp"

namespace ppm {

namespace {

std::string category(const std::string& module) {
  return module.substr(0, module.find('.'));
}

std::string join(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// "; it is of ..." where a shipped plug-in has the module's name behind the dot, as its modules are called.
std::string plugin_hint(const std::string& module) {
  for (const auto& plugin : shipped_plugins())
    if (module.ends_with("." + plugin.name))
      return fmt::format("; modules of that name are in a plug-in: write plugins: [{}]", plugin.name);
  return "";
}

/// What to write in place of an unknown module: the modules of its category, or the categories.
std::string known_modules(const std::string& name, const Registry& registry) {
  std::vector<std::string> same, categories;
  for (const auto& known : registry.names()) {
    if (category(known) == category(name)) same.push_back(known);
    if (categories.empty() || categories.back() != category(known)) categories.push_back(category(known));
  }
  if (!same.empty()) return fmt::format(" (category '{}' has {})", category(name), join(same));
  return fmt::format(" (categories: {})", join(categories));
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  auto guess = did_you_mean(word, candidates);
  return guess.empty() ? "" : fmt::format("; did you mean '{}'?", guess);
}

std::string a_kind(const Config& value) {
  if (value.kind() == Config::Kind::null) return kind_name(value.kind());
  return fmt::format("a {}", kind_name(value.kind()));
}

Graph GraphBuilder::build(Config file, const std::vector<Override>& overrides) {
  if (file.kind() != Config::Kind::map) {
    throw ConfigError(file.place(), fmt::format("a graph file is a map with name and nodes, not {}", a_kind(file)));
  }
  apply_overrides(overrides, file, mistakes_);
  read_file(file);
  wire();
  check_source(file);
  check_facets();
  check_map_kinds(file);
  if (mistakes_.empty()) return std::move(graph_);
  auto key = [](const Diagnostic& d) { return std::tie(d.place.file, d.place.line, d.place.column); };
  std::stable_sort(mistakes_.begin(), mistakes_.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
  throw ConfigError(std::move(mistakes_));
}

void GraphBuilder::read_file(const Config& file) {
  check_keys(file, "the graph", {"name", "seed", "checkpoint_every", "plugins", "nodes"});
  if (auto* name = required(file, "the graph", "name", Config::Kind::scalar)) {
    graph_.name_ = name->text();
    // It names the folder of the results.
    static const std::regex pattern("[A-Za-z0-9_][A-Za-z0-9_.-]*");
    if (!std::regex_match(graph_.name_, pattern)) {
      report(name->place(),
             fmt::format("graph name '{}': letters, digits, '_', '-' and '.', not '-' or '.' first", graph_.name_));
    }
  }
  graph_.seed_ = static_cast<std::uint64_t>(read_count(file, "seed"));
  graph_.checkpoint_every_ = read_count(file, "checkpoint_every");
  graph_.map_kinds_ = registry_.map_kinds();
  if (auto* plugins = file.find("plugins")) read_plugins(*plugins);
  for (const auto& [path, place] : Graph::plugins(file)) graph_.plugins_.push_back(path);
  auto* nodes = required(file, "the graph", "nodes", Config::Kind::sequence);
  if (!nodes) return;
  if (nodes->items().empty()) report(nodes->place(), "the graph has no nodes");
  graph_.nodes_.reserve(nodes->items().size());
  for (const auto& node : nodes->items()) read_node(node);
}

std::int64_t GraphBuilder::read_count(const Config& file, const std::string& key) {
  const Config* written = file.find(key);
  std::int64_t value = 0;
  if (!written) return value;
  Params params;
  params.add(key, value).range(0, std::numeric_limits<double>::infinity());
  Config only;
  only.set(key, written->place(), *written);
  params.parse(&only, "the graph", file.place(), mistakes_);
  return value;
}

void GraphBuilder::read_plugins(const Config& list) {
  if (list.kind() != Config::Kind::sequence) {
    report(list.place(), fmt::format("plugins is a list of libraries, not {}", a_kind(list)));
  }
  for (const auto& item : list.items()) {
    if (item.kind() != Config::Kind::scalar) report(item.place(), "a plug-in is the path of a library, or the name of one that ships");
  }
}

void GraphBuilder::read_node(const Config& tree) {
  if (tree.kind() != Config::Kind::map) {
    report(tree.place(), fmt::format("a node is a map such as {{name: x, module: y}}, not {}", a_kind(tree)));
    return;
  }
  check_keys(tree, "a node", {"name", "module", "in", "when", "params"});
  Node node;
  node.place = tree.place();
  read_node_name(tree, node);
  Place module_place = tree.place();
  make_module(tree, node, module_place);
  node.gate.parse(tree.find("when"), node.place, mistakes_);
  graph_.nodes_.push_back(std::move(node));
  written_.push_back({&tree, std::move(module_place)});
}

void GraphBuilder::read_node_name(const Config& tree, Node& node) {
  static const std::regex pattern("[A-Za-z][A-Za-z0-9_]*");
  const Config* name = required(tree, "a node", "name", Config::Kind::scalar);
  if (!name) return;
  node.name = name->text();
  if (!std::regex_match(node.name, pattern)) {
    report(name->place(), fmt::format("node name '{}': a letter first, then letters, digits and '_'", node.name));
  }
  for (const auto& other : graph_.nodes_) {
    if (other.name != node.name) continue;
    report(name->place(), fmt::format("node name '{}' is taken, by the node at {}", node.name, to_string(other.place)));
    break;
  }
}

void GraphBuilder::make_module(const Config& tree, Node& node, Place& place) {
  const Config* name = required(tree, "a node", "module", Config::Kind::scalar);
  const ModuleInfo* info = name ? registry_.find(name->text()) : nullptr;
  if (name && !info) {
    const auto plugin = plugin_hint(name->text());
    report(name->place(), fmt::format("unknown module '{}'{}", name->text(),
                                      !plugin.empty() ? plugin
                                                      : suggestion(name->text(), registry_.names()) +
                                                            known_modules(name->text(), registry_)));
    if (plugin.empty()) info = registry_.find(did_you_mean(name->text(), registry_.names()));
  }
  if (name) place = name->place();
  if (!info) {
    unknown_module_ = true;
    return;
  }
  node.module_name = info->name;
  node.module = info->make();
  node.module->params().parse(tree.find("params"), info->name, place, mistakes_);
}

void GraphBuilder::check_keys(const Config& map, const std::string& owner, const std::vector<std::string>& allowed) {
  for (const auto& entry : map.entries()) {
    if (std::ranges::find(allowed, entry.key) != allowed.end()) continue;
    auto hint = suggestion(entry.key, allowed);
    if (hint.empty()) hint = fmt::format("; keys: {}", join(allowed));
    report(entry.key_place, fmt::format("unknown key '{}' of {}{}", entry.key, owner, hint));
  }
}

const Config* GraphBuilder::required(const Config& map, const std::string& owner, const std::string& key,
                                     Config::Kind kind) {
  const Config* value = map.find(key);
  if (!value) {
    report(map.place(), fmt::format("{} needs the key '{}'", owner, key));
  } else if (value->kind() != kind) {
    report(value->place(), fmt::format("'{}' must be a {}, not {}", key, kind_name(kind), a_kind(*value)));
    return nullptr;
  }
  return value;
}

}  // namespace ppm
