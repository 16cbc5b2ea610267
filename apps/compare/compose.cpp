#include "apps/compare/compose.hpp"

#include <algorithm>

#include "framework/graph/graph_builder.hpp"
#include "framework/graph/override.hpp"

namespace ppm {

namespace {

/// Text of a node's key; "" where there is none.
std::string text_of(const Config& node, const std::string& key) {
  const Config* value = node.kind() == Config::Kind::map ? node.find(key) : nullptr;
  return value && value->kind() == Config::Kind::scalar ? value->text() : "";
}

bool gives_frames(const Config& node) {
  const auto module = text_of(node, "module");
  return module.starts_with("source.") || module.starts_with("preprocess.") || module.starts_with("sensor.");
}

Config* nodes_of(Config& graph) {
  Config* nodes = graph.kind() == Config::Kind::map ? graph.find("nodes") : nullptr;
  return nodes && nodes->kind() == Config::Kind::sequence ? nodes : nullptr;
}

/// Inputs "N.output" of the replaced nodes N read `frame`.
void rewire(Config& node, const std::vector<std::string>& replaced, const Config& frame) {
  Config* in = node.kind() == Config::Kind::map ? node.find("in") : nullptr;
  if (!in || in->kind() != Config::Kind::map) return;
  for (const auto& entry : std::vector<Config::Entry>(in->entries())) {
    const auto& from = entry.value.text();
    const auto dot = from.find('.');
    if (dot != std::string::npos && std::ranges::find(replaced, from.substr(0, dot)) != replaced.end())
      in->set(entry.key, entry.key_place, frame);
  }
}

void replace_frames(Config& nodes, const FrameNodes& frames) {
  std::vector<Config> kept;
  std::vector<std::string> replaced;
  std::size_t at = nodes.items().size();
  for (const auto& node : nodes.items()) {
    if (gives_frames(node)) {
      at = std::min(at, kept.size());
      replaced.push_back(text_of(node, "name"));
    } else {
      kept.push_back(node);
    }
  }
  for (auto& node : kept) rewire(node, replaced, frames.frame);
  at = replaced.empty() ? 0 : at;
  kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(at), frames.nodes.begin(), frames.nodes.end());
  nodes.items() = std::move(kept);
}

/// The node of that name, or the end after a report.
std::vector<Config>::iterator find_node(Config& nodes, const std::string& name, const Place& place, Diagnostics& mistakes) {
  std::vector<std::string> names;
  for (const auto& node : nodes.items()) names.push_back(text_of(node, "name"));
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) mistakes.push_back({place, fmt::format("the graph has no node '{}'{}", name, suggestion(name, names))});
  return nodes.items().begin() + (found - names.begin());
}

void change_nodes(Config& nodes, const Composition& how, Diagnostics& mistakes) {
  for (const auto& node : how.replace) {
    const auto old = find_node(nodes, text_of(node, "name"), node.place(), mistakes);
    if (old != nodes.items().end()) *old = node;
  }
  for (const auto& added : how.add) {
    const auto before = find_node(nodes, added.after, added.place, mistakes);
    if (before != nodes.items().end()) nodes.items().insert(before + 1, added.node);
  }
}

void make_plugins_absolute(Config& graph) {
  if (!graph.find("plugins")) return;
  const auto named = Graph::plugins(graph);
  std::vector<Config> paths;
  for (const auto& [path, place] : named) paths.push_back(Config::scalar(path.string(), place));
  Config& list = *graph.find("plugins");
  if (list.kind() == Config::Kind::sequence && list.items().size() == paths.size()) list.items() = std::move(paths);
}

}  // namespace

bool is_node(const Config& node, const std::string& word) {
  return text_of(node, "name") == word || text_of(node, "module") == word;
}

FrameNodes frame_nodes(const Config& graph) {
  FrameNodes frames;
  const Config* nodes = graph.kind() == Config::Kind::map ? graph.find("nodes") : nullptr;
  if (!nodes) return frames;
  for (const auto& node : nodes->items()) {
    if (!gives_frames(node)) continue;
    frames.nodes.push_back(node);
    frames.frame = Config::scalar(text_of(node, "name") + ".frame", node.place());
  }
  return frames;
}

Config compose(Config graph, const std::string& name, const Composition& how, Diagnostics& mistakes) {
  if (graph.kind() != Config::Kind::map) return graph;
  Config experiment = Config::map(graph.place());
  experiment.set("name", {}, Config::scalar(name, graph.place()));
  make_plugins_absolute(graph);
  for (const auto& entry : graph.entries())
    if (entry.key != "name" && entry.key != "seed") experiment.set(entry.key, entry.key_place, entry.value);
  if (Config* nodes = nodes_of(experiment)) {
    change_nodes(*nodes, how, mistakes);
    if (how.frames) replace_frames(*nodes, *how.frames);
    std::erase_if(nodes->items(), [&](const Config& node) {
      return std::ranges::any_of(how.drop, [&](const auto& word) { return is_node(node, word); });
    });
    apply_overrides(how.set, experiment, mistakes);
  }
  return experiment;
}

}  // namespace ppm
