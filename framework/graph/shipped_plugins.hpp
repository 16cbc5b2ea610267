#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ppm {

/// A plug-in that comes with ppm and is named without a path: `plugins: [octomap]`. It was built where the library that
/// it wraps was installed.
struct ShippedPlugin {
  std::string name;
  std::string package;            ///< the Debian package that it is built from
  std::filesystem::path file;     ///< the shared library
  bool built = false;             ///< whether the file is there
};

/// All that this ppm knows of, by name: in its build tree as well as installed.
std::vector<ShippedPlugin> shipped_plugins();

/// Whether a text names a shipped plug-in and not a library's file: letters, digits and '_' alone.
bool is_plugin_name(const std::string& text);

/// The file of the one of that name among them. Throws Error where there is none or it was not built, naming what to
/// install.
std::filesystem::path library_of(const std::string& name, const std::vector<ShippedPlugin>& all);

}  // namespace ppm
