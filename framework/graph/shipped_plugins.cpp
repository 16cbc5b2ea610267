#include "framework/graph/shipped_plugins.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <regex>

#include "framework/config/config.hpp"
#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// Beside the library that this code is in: lib/ppm/plugins, with NAME.package (what it is built from) for each that
/// ships and NAME.so for each that was built.
std::filesystem::path folder() {
  Dl_info self{};
  PPM_CHECK(dladdr(reinterpret_cast<const void*>(&is_plugin_name), &self), "the framework's own library is unknown");
  return std::filesystem::absolute(self.dli_fname).parent_path() / "ppm/plugins";
}

}  // namespace

std::vector<ShippedPlugin> shipped_plugins() {
  std::vector<ShippedPlugin> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder(), none)) {
    if (entry.path().extension() != ".package") continue;
    ShippedPlugin& plugin = found.emplace_back();
    plugin.name = entry.path().stem().string();
    std::ifstream(entry.path()) >> plugin.package;
    plugin.file = folder() / (plugin.name + ".so");
    plugin.built = std::filesystem::exists(plugin.file);
  }
  std::ranges::sort(found, {}, &ShippedPlugin::name);
  return found;
}

bool is_plugin_name(const std::string& text) {
  static const std::regex pattern("[A-Za-z0-9_]+");
  return std::regex_match(text, pattern);
}

std::filesystem::path library_of(const std::string& name, const std::vector<ShippedPlugin>& all) {
  const auto found = std::ranges::find(all, name, &ShippedPlugin::name);
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const auto& plugin : all) names.push_back(plugin.name);
    const auto near = did_you_mean(name, names);
    throw Error(fmt::format("ppm ships no plug-in '{}'{} (it has: {}; another is named by its file, {}.so)", name,
                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(names, ", "),
                            name));
  }
  if (!found->built) {
    throw Error(fmt::format("plug-in '{}' is not built: install the Debian package {} (`bash apps/install_packages.sh "
                            "--optional`) and build ppm again",
                            name, found->package));
  }
  return found->file;
}

}  // namespace ppm
