#include "apps/compare/compose.hpp"

#include <algorithm>

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

/// The node of that name, or the end, after a report.
std::vector<Config>::iterator find_node(Config& nodes, const std::string& name, const Place& place, Diagnostics& mistakes) {
  auto& all = nodes.items();
  const auto at = std::ranges::find_if(all, [&](const Config& node) { return text_of(node, "name") == name; });
  if (at == all.end()) mistakes.push_back({place, fmt::format("the graph has no node '{}'", name)});
  return at;
}

void change_nodes(Config& nodes, const SuiteGraph& changes, Diagnostics& mistakes) {
  for (const auto& node : changes.replaced) {
    const auto at = find_node(nodes, text_of(node, "name"), node.place(), mistakes);
    if (at != nodes.items().end()) *at = node;
  }
  for (const auto& added : changes.added) {
    const auto at = find_node(nodes, added.after, added.node.place(), mistakes);
    if (at != nodes.items().end()) nodes.items().insert(at + 1, added.node);
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

std::optional<std::pair<std::string, std::string>> split_key(const std::string& text) {
  const auto dot = text.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text.size()) return std::nullopt;
  return std::pair(text.substr(0, dot), text.substr(dot + 1));
}

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
    if (how.changes) change_nodes(*nodes, *how.changes, mistakes);
    if (how.frames) replace_frames(*nodes, *how.frames);
    std::erase_if(nodes->items(), [&](const Config& node) {
      return std::ranges::any_of(how.drop, [&](const auto& word) { return is_node(node, word); });
    });
    apply_overrides(how.set, experiment, mistakes);
  }
  return experiment;
}

}  // namespace ppm
