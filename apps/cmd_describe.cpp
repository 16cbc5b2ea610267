#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/graph/describe.hpp"

namespace ppm {

namespace {

struct DescribeOptions {
  std::string module;
  bool markdown = false;
  std::filesystem::path pages;
  std::vector<std::filesystem::path> plugins;
};

void write_pages(const Registry& registry, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] : module_pages(registry)) write_file(folder / name, text);
}

void describe(const DescribeOptions& options) {
  const Registry registry = make_registry(options.plugins);
  if (!options.pages.empty()) return write_pages(registry, options.pages);
  if (options.module.empty()) throw ConfigError({}, "describe needs a MODULE or --pages FOLDER");
  const ModuleInfo* info = registry.find(options.module);
  if (!info) {
    const auto near = did_you_mean(options.module, registry.names());
    throw ConfigError(
        {}, fmt::format("no module '{}'; {}", options.module,
                        near.empty() ? "'ppm list' names them all" : fmt::format("did you mean '{}'?", near)));
  }
  fmt::print("{}", options.markdown ? describe_markdown(*info) : describe_text(*info));
}

}  // namespace

void add_describe(CLI::App& app) {
  auto* command = app.add_subcommand("describe", "Tells all about a module: ports, parameters, source");
  auto options = std::make_shared<DescribeOptions>();
  command->add_option("module", options->module, "For example motion.constant_velocity")->type_name("MODULE");
  command->add_flag("--markdown", options->markdown, "As a page of the documentation");
  command->add_option("--pages", options->pages, "Writes the pages of all modules into a folder instead")
      ->type_name("FOLDER");
  add_plugin_option(*command, options->plugins);
  command->callback([options] { describe(*options); });
}

}  // namespace ppm
