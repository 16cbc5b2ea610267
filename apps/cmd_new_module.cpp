#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/core.h>
#include <memory>

#include "apps/commands.hpp"
#include "apps/graph_options.hpp"
#include "apps/module_skeleton.hpp"
#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

struct NewModuleOptions {
  std::string name;
  std::filesystem::path folder;
};

void print_built_in(const std::filesystem::path& file, const std::string& line) {
  fmt::print("wrote {}\nAdd this line to modules/CMakeLists.txt and build:\n  ppm_add_module({})\n", file.string(),
             line);
}

void print_plugin(const std::filesystem::path& file, const std::string& target) {
  fmt::print(
      "wrote {0}\nAs a plug-in: a CMakeLists.txt beside it with\n"
      "  cmake_minimum_required(VERSION 3.22)\n  project({1} CXX)\n  find_package(ppm REQUIRED)\n  ppm_add_plugin({1} "
      "{2})\n"
      "then build it and use it by name:\n  cmake -B build && cmake --build build\n  ppm run GRAPH --plugin "
      "build/{1}.so\n",
      file.string(), target, file.filename().string());
}

void write_new(const std::filesystem::path& file, const std::string& module) {
  if (std::filesystem::exists(file)) throw ConfigError(Place{file.string()}, "is there already; it is not overwritten");
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_file(file, module_skeleton(module));
}

void new_module(const NewModuleOptions& options) {
  if (auto wrong = refuse_module_name(options.name); !wrong.empty()) throw ConfigError(Place{options.name}, wrong);
  if (make_registry({}).find(options.name)) throw ConfigError(Place{options.name}, "there is a module of that name");
  const auto dot = options.name.find('.');
  const std::string category = options.name.substr(0, dot), name = options.name.substr(dot + 1);
  if (options.folder.empty() && std::filesystem::exists("modules/CMakeLists.txt")) {
    const auto line = module_folder(category) + "/" + name + ".cpp";
    const auto file = std::filesystem::path("modules") / line;
    write_new(file, options.name);
    print_built_in(file, line);
  } else {
    const auto file = options.folder / (name + ".cpp");
    write_new(file, options.name);
    print_plugin(file, name);
  }
}

}  // namespace

void add_new_module(CLI::App& app) {
  auto* command = app.add_subcommand("new-module", "Writes the source of a new module and tells how to build it");
  auto options = std::make_shared<NewModuleOptions>();
  command->add_option("name", options->name, "For example motion.mine")->required()->type_name("CATEGORY.NAME");
  command
      ->add_option("--dir", options->folder,
                   "Folder for a plug-in (default: modules/ where the working directory is the project, else the "
                   "working directory)")
      ->type_name("FOLDER");
  command->callback([options] { new_module(*options); });
}

}  // namespace ppm
