#include <algorithm>

#include "apps/compare/suite_reader.hpp"
#include "framework/graph/graph_builder.hpp"

namespace ppm {

namespace {

/// "node.key" of an override.
std::string key_of(const Override& o) {
  return o.node + "." + o.key;
}

/// A value as it stands in a name: "1 cm", "[0, 0, 1]".
std::string text_of(const Config& value) {
  if (value.kind() == Config::Kind::scalar) return value.text();
  auto text = value.to_yaml();
  text.pop_back();  // the end of the line
  return text;
}

std::string point_text(const std::vector<Override>& point) {
  std::string text;
  for (const auto& o : point) text += (text.empty() ? "" : ",") + key_of(o) + "=" + text_of(o.value);
  return text;
}

}  // namespace

SuiteSequence SuiteReader::read_sequence(const Config& tree) {
  SuiteSequence sequence;
  sequence.place = tree.place();
  std::filesystem::path like;
  Params params;
  params.add("name", sequence.name).required();
  params.add("title", sequence.title);
  params.add("like", like);
  read_fields(tree, "a sequence", params, {"nodes", "frame", "set", "seed"}, mistakes_);
  if (!sequence.name.empty()) check_name(sequence.name, tree.find("name")->place(), "sequence name", mistakes_);
  if (sequence.title.empty()) sequence.title = sequence.name;
  if (const auto* written = tree.find("like")) {
    sequence.like = path_beside(written->place(), like);
    sequence.like_place = written->place();
  }
  if (const auto* nodes = field(tree, "nodes", Config::Kind::sequence, mistakes_)) {
    if (nodes->items().empty()) report(nodes->place(), "the sequence has no nodes");
    sequence.nodes = *nodes;
  }
  if (tree.find("nodes") && tree.find("like")) report(tree.place(), "a sequence has 'nodes' or 'like', not both");
  if (!tree.find("nodes") && !tree.find("like")) report(tree.place(), "a sequence needs 'nodes', or 'like' for those of another graph");
  if (const auto* frame = field(tree, "frame", Config::Kind::scalar, mistakes_)) sequence.frame = *frame;
  sequence.set = read_set(tree, "set");
  if (const auto* seed = tree.find("seed")) {
    const auto list = seed->kind() == Config::Kind::scalar ? Config::sequence({*seed}, seed->place()) : *seed;
    for (const auto& [word, place] : read_words(list, "what gets the seed is a parameter, node.key", mistakes_)) {
      sequence.seeded.push_back(split_key(word, place));
      sequence.seeded.back().value = Config::scalar(word, place);
    }
  }
  return sequence;
}

void SuiteReader::read_graph(const Config& tree, Comparison& comparison) {
  SuiteGraph graph;
  graph.place = tree.place();
  std::filesystem::path file;
  Params params;
  params.add("name", graph.base_name).required();
  params.add("title", graph.title);
  params.add("graph", file).required();
  params.add("memory", graph.memory_bytes).unit("bytes").above(0);
  params.add("optional", graph.optional);
  read_fields(tree, "a graph", params, {"replace", "add", "set", "set_for", "sweep", "drop"}, mistakes_);
  if (!graph.base_name.empty()) check_name(graph.base_name, tree.find("name")->place(), "graph name", mistakes_);
  if (graph.title.empty()) graph.title = graph.base_name;
  if (const auto* written = tree.find("graph")) {
    graph.file = path_beside(written->place(), file);
    graph.file_place = written->place();
  }
  read_nodes(tree, graph);
  graph.set = read_set(tree, "set");
  read_set_for(tree, comparison, graph);
  if (const auto* drop = field(tree, "drop", Config::Kind::sequence, mistakes_))
    graph.drop = read_words(*drop, "what is dropped is a node's name or a module", mistakes_);
  const auto points = read_sweep(tree);
  if (!points.empty()) check_swept(graph, points[0]);
  graph.name = graph.base_name;
  if (points.empty()) {
    check_taken(graph.name, graph.place, "graph", comparison.graphs);
    comparison.graphs.push_back(graph);
  }
  for (const auto& point : points) {
    SuiteGraph swept = graph;
    swept.name += "[" + point_text(point) + "]";
    swept.title += ", " + point_text(point);
    swept.sweep = point;
    check_taken(swept.name, graph.place, "graph", comparison.graphs);
    comparison.graphs.push_back(std::move(swept));
  }
}

bool SuiteReader::names_node(const Config& node, const std::string& key) {
  const Config* name = node.find(key);
  if (name && name->kind() == Config::Kind::scalar) return true;
  report(name ? name->place() : node.place(), fmt::format("the node needs '{}', the name of a node", key));
  return false;
}

/// Nodes in place of others, and besides them. Whether they are as nodes have to be is seen when the graph is built.
void SuiteReader::read_nodes(const Config& tree, SuiteGraph& graph) {
  if (const auto* replace = field(tree, "replace", Config::Kind::sequence, mistakes_)) {
    for (const auto& node : replace->items())
      if (is_map(node, "a node", "{name: x, module: y}", mistakes_) && names_node(node, "name")) graph.replace.push_back(node);
  }
  const auto* add = field(tree, "add", Config::Kind::sequence, mistakes_);
  if (!add) return;
  for (const auto& item : add->items()) {
    if (!is_map(item, "an added node", "{after: w, name: x, module: y}", mistakes_) || !names_node(item, "after")) continue;
    AddedNode added{item.find("after")->text(), item.place(), Config::map(item.place())};
    for (const auto& entry : item.entries())
      if (entry.key != "after") added.node.set(entry.key, entry.key_place, entry.value);
    graph.add.push_back(std::move(added));
  }
}

Override SuiteReader::split_key(const std::string& key, const Place& place) {
  const auto dot = key.find('.');
  if (dot != std::string::npos && dot > 0 && dot + 1 < key.size()) return {key.substr(0, dot), key.substr(dot + 1), Config()};
  report(place, fmt::format("'{}': write node.key", key));
  return {"", "", Config()};
}

std::vector<Override> SuiteReader::read_set(const Config& tree, const std::string& key) {
  std::vector<Override> set;
  const auto* map = field(tree, key, Config::Kind::map, mistakes_);
  if (!map) return set;
  for (const auto& entry : map->entries()) {
    set.push_back(split_key(entry.key, entry.key_place));
    set.back().value = entry.value;
  }
  return set;
}

void SuiteReader::read_set_for(const Config& tree, const Comparison& comparison, SuiteGraph& graph) {
  const auto* map = field(tree, "set_for", Config::Kind::map, mistakes_);
  if (!map) return;
  std::vector<std::string> sequences;
  for (const auto& s : comparison.sequences) sequences.push_back(s.name);
  for (const auto& entry : map->entries()) {
    if (std::ranges::find(sequences, entry.key) == sequences.end())
      report(entry.key_place, fmt::format("no sequence '{}'{}", entry.key, suggestion(entry.key, sequences)));
    graph.set_for[entry.key] = read_set(*map, entry.key);
  }
}

/// Every combination, the first key's values outermost.
std::vector<std::vector<Override>> SuiteReader::read_sweep(const Config& tree) {
  std::vector<std::vector<Override>> points;
  for (const auto& axis : read_set(tree, "sweep")) {
    if (axis.value.kind() != Config::Kind::sequence || axis.value.items().empty()) {
      report(axis.value.place(), fmt::format("a sweep is a list of values, {}: [1 cm, 2 cm]", key_of(axis)));
      continue;
    }
    if (points.empty()) points.emplace_back();
    std::vector<std::vector<Override>> longer;
    for (const auto& point : points) {
      for (const auto& value : axis.value.items()) {
        longer.push_back(point);
        longer.back().push_back({axis.node, axis.key, value});
      }
    }
    points = std::move(longer);
  }
  return points;
}

void SuiteReader::check_swept(const SuiteGraph& graph, const std::vector<Override>& point) {
  auto check = [&](const std::vector<Override>& set) {
    for (const auto& o : set)
      for (const auto& swept : point)
        if (key_of(o) == key_of(swept)) report(o.value.place(), fmt::format("'{}' is set and swept", key_of(o)));
  };
  check(graph.set);
  for (const auto& [sequence, set] : graph.set_for) check(set);
}

}  // namespace ppm
