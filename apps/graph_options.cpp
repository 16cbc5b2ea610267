#include "apps/graph_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "framework/graph/plugin.hpp"
#include "framework/graph/shipped_plugins.hpp"
#include "modules/builtin.hpp"

namespace ppm {

namespace {

/// Collects the mistakes of several steps, so that one run tells them all.
class Mistakes {
 public:
  template <class F>
  void collect(F&& step) {
    try {
      step();
    } catch (const ConfigError& e) {
      all_.insert(all_.end(), e.diagnostics().begin(), e.diagnostics().end());
    }
  }
  void throw_if_any() {
    if (!all_.empty()) throw ConfigError(std::move(all_));
  }

 private:
  Diagnostics all_;
};

}  // namespace

Registry make_registry(const std::vector<std::filesystem::path>& plugins) {
  Registry registry;
  register_builtin(registry);
  Mistakes mistakes;
  for (const auto& library : plugins)
    mistakes.collect([&] { load_plugin(library, Place{"--plugin " + library.string()}, registry); });
  mistakes.throw_if_any();
  return registry;
}

void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& plugins) {
  command.add_option("--plugin", plugins, "Shared library with further modules, or the name of one that ships; may be repeated")
      ->allow_extra_args(false)
      ->type_name("LIBRARY");
}

void GraphOptions::add_to(CLI::App& command) {
  command.add_option("graph", file, "Graph file (YAML)")->required()->type_name("FILE");
  command.add_option("--set", set, "A parameter in place of the file's, node.key=value; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NODE.KEY=VALUE");
  command.add_option("--seed", seed, "Seed in place of the file's")->type_name("N");
  add_plugin_option(command, plugins);
}

namespace {

/// Adds the command line's plug-ins to those of the file, so that the effective graph names all that it needs.
void add_plugins(const std::vector<std::filesystem::path>& plugins, Config& tree) {
  if (plugins.empty() || tree.kind() != Config::Kind::map) return;
  if (!tree.find("plugins")) tree.set("plugins", {}, Config::sequence({}, {}));
  Config& list = *tree.find("plugins");
  if (list.kind() != Config::Kind::sequence) return;  // building the graph says so
  for (const auto& library : plugins) {
    const bool shipped = is_plugin_name(library.string());
    const auto path = shipped ? library : std::filesystem::absolute(library).lexically_normal();
    const auto named = Graph::plugins(tree);
    if (std::ranges::none_of(named, [&](const auto& known) { return known.first == path; }))
      list.items().push_back(Config::scalar(path.string(), Place{"--plugin " + library.string()}));
  }
}

}  // namespace

Graph GraphOptions::load() const {
  Config tree = load_yaml(file);
  Registry registry = make_registry(plugins);
  Mistakes mistakes;
  for (const auto& [library, place] : Graph::plugins(tree))
    mistakes.collect([&, lib = library, at = place] { load_plugin(lib, at, registry); });
  mistakes.throw_if_any();  // without a plug-in each of its modules would be a mistake of its own
  std::vector<Override> overrides;
  for (const auto& text : set) mistakes.collect([&] { overrides.push_back(parse_override(text)); });
  if (seed) overrides.push_back(Override{"", "seed", Config::scalar(std::to_string(*seed), Place{"--seed"})});
  if (checkpoint_every)
    overrides.push_back(Override{"", "checkpoint_every",
                                 Config::scalar(std::to_string(*checkpoint_every), Place{"--checkpoint-every"})});
  add_plugins(plugins, tree);
  Graph graph;
  mistakes.collect([&] { graph = Graph::build(tree, registry, overrides); });
  mistakes.throw_if_any();
  return graph;
}

}  // namespace ppm
