#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "framework/graph/describe.hpp"

namespace ppm {

namespace {

struct WiringOptions {
  GraphOptions graph;
  bool dot = false;
};

}  // namespace

void add_graph(CLI::App& app) {
  auto* command = app.add_subcommand("graph", "Prints how a graph is wired");
  auto options = std::make_shared<WiringOptions>();
  options->graph.add_to(*command);
  command->add_flag("--dot", options->dot, "For Graphviz: ppm graph FILE --dot | dot -Tsvg");
  command->callback([options] {
    const Graph graph = options->graph.load();
    fmt::print("{}", options->dot ? graph_dot(graph) : graph_text(graph));
  });
}

}  // namespace ppm
