#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "framework/graph/graph_builder.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

namespace {

std::vector<PortBase*> ports_of(const Node& node, PortDirection direction) {
  std::vector<PortBase*> found;
  if (!node.module) return found;
  for (auto* port : node.module->ports()) {
    if (port->direction() == direction) found.push_back(port);
  }
  return found;
}

/// What an `in:` line can name.
std::vector<PortBase*> inputs_of(const Node& node) {
  auto inputs = ports_of(node, PortDirection::in);
  for (auto* port : ports_of(node, PortDirection::use)) inputs.push_back(port);
  return inputs;
}

PortBase* find_port(const Node& node, PortDirection direction, const std::string& name) {
  for (auto* port : ports_of(node, direction)) {
    if (port->name() == name) return port;
  }
  return nullptr;
}

std::vector<std::string> names_of(const std::vector<PortBase*>& ports) {
  std::vector<std::string> names;
  for (auto* port : ports) names.push_back(port->name());
  return names;
}

/// "; did you mean 'x'?", else "; its outputs: x, y", else "; it has no outputs".
std::string port_hint(const std::string& word, const std::vector<PortBase*>& ports, const std::string& what) {
  auto names = names_of(ports);
  auto hint = suggestion(word, names);
  if (!hint.empty()) return hint;
  return names.empty() ? "; it has no " + what : fmt::format("; its {}: {}", what, fmt::join(names, ", "));
}

/// A node that makes values and needs none: it alone can end a run.
bool is_source(const Node& node) {
  return !ports_of(node, PortDirection::out).empty() && inputs_of(node).empty() &&
         ports_of(node, PortDirection::belief).empty();
}

}  // namespace

void GraphBuilder::wire() {
  for (std::size_t i = 0; i < graph_.nodes_.size(); ++i) {
    for (auto* port : ports_of(graph_.nodes_[i], PortDirection::belief)) {
      static_cast<BeliefPortBase*>(port)->belief_ = graph_.belief_.get();
    }
    wire_node(i);
    make_outputs(i);
  }
}

void GraphBuilder::wire_node(std::size_t i) {
  const Config* in = written_[i].tree->find("in");
  if (in && in->kind() != Config::Kind::map) {
    report(in->place(), fmt::format("'in' is a map such as {{frame: camera.frame}}, not {}", a_kind(*in)));
    return;
  }
  std::set<const PortBase*> meant;
  for (const auto& entry : in ? in->entries() : std::vector<Config::Entry>{}) {
    PortBase* input = find_input(i, entry);
    if (input && input->direction() == PortDirection::use) {
      meant.insert(input);
      use_node(i, static_cast<UsePortBase&>(*input), entry.value);
      continue;
    }
    const PortBase* output = find_output(i, entry.value);
    meant.insert(input);
    if (input && output) connect(i, *input, *output, entry.value);
  }
  for (auto* port : inputs_of(graph_.nodes_[i])) {
    if (!meant.contains(port)) report_unwired(i, *port);
  }
}

PortBase* GraphBuilder::find_input(std::size_t i, const Config::Entry& entry) {
  const Node& node = graph_.nodes_[i];
  for (const auto direction : {PortDirection::in, PortDirection::use})
    if (PortBase* input = find_port(node, direction, entry.key)) return input;
  if (!node.module) return nullptr;
  if (find_port(node, PortDirection::belief, entry.key)) {
    report(entry.key_place, "the belief needs no 'in' line: it goes through the nodes from top to bottom");
    return nullptr;
  }
  const auto inputs = inputs_of(node);
  report(entry.key_place, fmt::format("module '{}' has no input '{}'{}", node.module_name, entry.key,
                                      port_hint(entry.key, inputs, "inputs")));
  const auto meant = did_you_mean(entry.key, names_of(inputs));
  const auto found = std::ranges::find(inputs, meant, [](auto* port) { return port->name(); });
  return found == inputs.end() ? nullptr : *found;
}

void GraphBuilder::use_node(std::size_t i, UsePortBase& input, const Config& named) {
  const Node& user = graph_.nodes_[i];
  const auto& name = named.text();
  if (named.kind() != Config::Kind::scalar || name.find('.') != std::string::npos) {
    report(named.place(), fmt::format("input '{}' names a node that is called, such as 'look', without an output", input.name()));
    return;
  }
  std::vector<std::string> others;
  for (const auto& node : graph_.nodes_) {
    if (&node == &user) continue;
    others.push_back(node.name);
    if (node.name != name) continue;
    if (!node.module) return;  // reported where it is written
    input.used_ = input.as_used(*node.module);
    if (!input.used_)
      report(named.place(), fmt::format("input '{}' takes a node that is a '{}', but '{}' is '{}'", input.name(),
                                        input.type_name(), name, node.module_name));
    graph_.nodes_[i].edges.push_back({input.name(), name});
    return;
  }
  report(named.place(), user.name == name ? fmt::format("node '{}' cannot use itself", name)
                                          : fmt::format("no node '{}'{}", name, suggestion(name, others)));
}

void GraphBuilder::connect(std::size_t i, PortBase& input, const PortBase& output, const Config& source) {
  if (input.type() != output.type()) {
    report(source.place(), fmt::format("input '{}' takes a '{}', but '{}' is a '{}'", input.name(), input.type_name(),
                                       source.text(), output.type_name()));
    return;
  }
  input.slot_ = output.slot_;
  graph_.nodes_[i].edges.push_back({input.name(), source.text()});
}

const PortBase* GraphBuilder::find_output(std::size_t i, const Config& source) {
  const auto& text = source.text();
  const auto dot = text.find('.');
  if (source.kind() != Config::Kind::scalar || dot == std::string::npos) {
    report(source.place(), "an input is written as node.output, such as camera.frame");
    return nullptr;
  }
  const std::string name = text.substr(0, dot), port = text.substr(dot + 1);
  const auto end = graph_.nodes_.begin() + static_cast<std::ptrdiff_t>(i);
  const auto maker = std::find_if(graph_.nodes_.begin(), end, [&](const Node& n) { return n.name == name; });
  if (maker == end) {
    report(source.place(), no_node_above(i, name));
    return nullptr;
  }
  const PortBase* output = find_port(*maker, PortDirection::out, port);
  if (!output && maker->module) {
    report(source.place(), fmt::format("node '{}' has no output '{}'{}", name, port,
                                       port_hint(port, ports_of(*maker, PortDirection::out), "outputs")));
  }
  return output;
}

std::string GraphBuilder::no_node_above(std::size_t i, const std::string& name) const {
  const auto& nodes = graph_.nodes_;
  if (nodes[i].name == name) return fmt::format("node '{}' cannot use its own output", name);
  std::vector<std::string> above;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k < i) above.push_back(nodes[k].name);
    if (k > i && nodes[k].name == name)
      return fmt::format("node '{}' is below; nodes use only what was made above them", name);
  }
  return fmt::format("no node '{}' above{}", name, suggestion(name, above));
}

void GraphBuilder::report_unwired(std::size_t i, const PortBase& input) {
  std::vector<std::string> above;
  for (const auto& node : graph_.nodes_) {
    if (input.direction() != PortDirection::use || !node.module) continue;
    if (static_cast<const UsePortBase&>(input).as_used(*node.module)) above.push_back(node.name);
  }
  for (std::size_t k = 0; k < i; ++k) {
    for (auto* port : ports_of(graph_.nodes_[k], PortDirection::out)) {
      if (port->type() == input.type()) above.push_back(graph_.nodes_[k].name + "." + port->name());
    }
  }
  const bool use = input.direction() == PortDirection::use;
  std::string hint = fmt::format("no node {} '{}'", use ? "is a" : "above makes a", input.type_name());
  if (above.size() == 1) hint = fmt::format("did you mean in: {{{}: {}}}?", input.name(), above[0]);
  if (above.size() > 1)
    hint = fmt::format("{}: {}", use ? "nodes of its kind" : "outputs of its type above", fmt::join(above, ", "));
  report(written_[i].module,
         fmt::format("input '{}' of module '{}' is not wired; {}", input.name(), graph_.nodes_[i].module_name, hint));
}

void GraphBuilder::make_outputs(std::size_t i) {
  const Node& node = graph_.nodes_[i];
  for (auto* port : ports_of(node, PortDirection::out)) {
    graph_.slots_.push_back(std::make_unique<std::shared_ptr<const void>>());
    port->slot_ = graph_.slots_.back().get();
    if (!node.gate.always() && !port->identity()) {
      report(
          written_[i].tree->find("when")->place(),
          fmt::format(
              "module '{}' cannot have 'when': nothing stands in for its output '{}' in frames where it does not run",
              node.module_name, port->name()));
    }
  }
}

void GraphBuilder::check_source(const Config& file) {
  if (unknown_module_ || graph_.nodes_.empty() || std::ranges::any_of(graph_.nodes_, is_source)) return;
  std::vector<std::string> sources;
  for (const auto& name : registry_.names()) {
    if (name.starts_with("source.")) sources.push_back(name);
  }
  report(file.find("nodes")->place(),
         fmt::format("the graph has no source of frames; modules that are one: {}", fmt::join(sources, ", ")));
}

}  // namespace ppm
