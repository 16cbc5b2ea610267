#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"

namespace CLI {
class App;
}

namespace ppm {

/// Built-in modules and those of plug-ins. Throws ConfigError for a plug-in that cannot be loaded.
Registry make_registry(const std::vector<std::filesystem::path>& plugins);
/// --plugin LIBRARY, any number of times.
void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& plugins);

/// The options of every command that takes a graph.
struct GraphOptions {
  std::filesystem::path file;
  std::vector<std::string> set;  ///< "node.key=value"
  std::optional<std::uint64_t> seed;
  std::optional<std::int64_t> checkpoint_every;  ///< an option of `ppm run` alone
  std::vector<std::filesystem::path> plugins;

  void add_to(CLI::App& command);
  /// Builds the graph. Throws one ConfigError with every mistake of file and command line.
  Graph load() const;
};

}  // namespace ppm
