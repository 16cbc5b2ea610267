#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/compare/suite_schema.hpp"
#include "apps/graph_options.hpp"
#include "framework/graph/describe.hpp"

namespace ppm {

void add_schema(CLI::App& app) {
  auto* command = app.add_subcommand("schema", "Prints the JSON Schema of graph files, or of suites, for editors");
  auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  add_plugin_option(*command, *plugins);
  auto suite = std::make_shared<bool>(false);
  command->add_flag("--suite", *suite, "The schema of suite files (ppm compare)");
  command->callback([plugins, suite] { fmt::print("{}", *suite ? suite_schema() : graph_schema(make_registry(*plugins))); });
}

}  // namespace ppm
