#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "framework/graph/describe.hpp"

namespace ppm {

void add_schema(CLI::App& app) {
  auto* command = app.add_subcommand("schema", "Prints the JSON Schema of graph files, for editors");
  auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  add_plugin_option(*command, *plugins);
  command->callback([plugins] { fmt::print("{}", graph_schema(make_registry(*plugins))); });
}

}  // namespace ppm
