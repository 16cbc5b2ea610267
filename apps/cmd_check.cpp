#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"

namespace ppm {

void add_check(CLI::App& app) {
  auto* command = app.add_subcommand("check", "Checks a graph and tells every mistake with its place; runs nothing");
  auto options = std::make_shared<GraphOptions>();
  options->add_to(*command);
  command->callback([options] {
    const Graph graph = options->load();
    fmt::print("{}: graph '{}' with {} nodes is sound\n", options->file.string(), graph.name(), graph.nodes().size());
  });
}

}  // namespace ppm
