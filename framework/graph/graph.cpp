#include "framework/graph/graph.hpp"

#include "framework/graph/graph_builder.hpp"
#include "framework/graph/shipped_plugins.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

Graph::Graph() : belief_(std::make_unique<ParticleSet>()) {}
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;
Graph::~Graph() = default;

Graph Graph::build(const Config& file, const Registry& registry, const std::vector<Override>& overrides) {
  return GraphBuilder(registry).build(file, overrides);
}

std::vector<std::pair<std::filesystem::path, Place>> Graph::plugins(const Config& file) {
  std::vector<std::pair<std::filesystem::path, Place>> found;
  const Config* list = file.kind() == Config::Kind::map ? file.find("plugins") : nullptr;
  if (!list) return found;
  for (const auto& item : list->items()) {
    if (item.kind() != Config::Kind::scalar) continue;  // build() says so
    if (is_plugin_name(item.text())) {
      found.emplace_back(item.text(), item.place());
      continue;
    }
    auto folder = std::filesystem::path(item.place().file).parent_path();
    found.emplace_back(std::filesystem::absolute(folder / item.text()).lexically_normal(), item.place());
  }
  return found;
}

std::string Graph::effective_yaml() const {
  return effective(checkpoint_every_).to_yaml();
}

std::string Graph::experiment_yaml() const {
  return effective(0).to_yaml();
}

Config Graph::effective(std::int64_t checkpoint_every) const {
  auto text = [](std::string value) { return Config::scalar(std::move(value), {}); };
  Config root;
  root.set("name", {}, text(name_));
  root.set("seed", {}, text(std::to_string(seed_)));
  if (checkpoint_every > 0) root.set("checkpoint_every", {}, text(std::to_string(checkpoint_every)));
  std::vector<Config> libraries;
  for (const auto& path : plugins_) libraries.push_back(text(path.string()));
  if (!libraries.empty()) root.set("plugins", {}, Config::sequence(std::move(libraries), {}));
  std::vector<Config> nodes;
  for (const auto& node : nodes_) {
    Config& entry = nodes.emplace_back();
    entry.set("name", {}, text(node.name));
    entry.set("module", {}, text(node.module_name));
    Config in;
    for (const auto& edge : node.edges) in.set(edge.port, {}, text(edge.from));
    if (!node.edges.empty()) entry.set("in", {}, std::move(in));
    if (!node.gate.always()) entry.set("when", {}, node.gate.effective());
    if (!node.module->params().specs().empty()) entry.set("params", {}, node.module->params().effective());
  }
  root.set("nodes", {}, Config::sequence(std::move(nodes), {}));
  return root;
}

}  // namespace ppm
