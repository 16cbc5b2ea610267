#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"

namespace ppm {

namespace {

struct ListOptions {
  std::string category;
  bool names = false;
  std::vector<std::filesystem::path> plugins;
};

std::string category_of(const std::string& module) {
  return module.substr(0, module.find('.'));
}

void check_category(const std::string& category, const std::vector<const ModuleInfo*>& all) {
  std::vector<std::string> known;
  for (const auto* info : all) known.push_back(category_of(info->name));
  if (std::ranges::find(known, category) != known.end()) return;
  const auto near = did_you_mean(category, known);
  throw ConfigError(
      {}, fmt::format("no category '{}'{}", category, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

void list(const ListOptions& options) {
  const Registry registry = make_registry(options.plugins);
  auto modules = registry.all();
  if (!options.category.empty()) {
    check_category(options.category, modules);
    std::erase_if(modules, [&](const auto* info) { return category_of(info->name) != options.category; });
  }
  std::size_t width = 0;
  for (const auto* info : modules) width = std::max(width, info->name.size());
  for (const auto* info : modules) {
    if (options.names) {
      fmt::print("{}\n", info->name);
    } else {
      fmt::print("{:<{}}  {}{}\n", info->name, width, info->summary,
                 info->origin == "built in" ? "" : " [" + info->origin + "]");
    }
  }
}

}  // namespace

void add_list(CLI::App& app) {
  auto* command = app.add_subcommand("list", "Lists the modules that graphs can name");
  auto options = std::make_shared<ListOptions>();
  command->add_option("category", options->category, "Only these, for example motion")->type_name("CATEGORY");
  command->add_flag("--names", options->names, "Only the names");
  add_plugin_option(*command, options->plugins);
  command->callback([options] { list(*options); });
}

}  // namespace ppm
