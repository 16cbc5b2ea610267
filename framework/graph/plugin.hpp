#pragma once
#include <filesystem>

#include "framework/core/error.hpp"
#include "framework/graph/registry.hpp"

namespace ppm {

/// Loads a shared library of modules and registers them. library: a file, or the name of a plug-in that ships with ppm
/// (see shipped_plugins.hpp). The library stays loaded for the life of the process: objects
/// of its types may outlive any scope. Throws ConfigError at `place`: not found or not built, not a plug-in, or built
/// against other headers.
void load_plugin(const std::filesystem::path& library, const Place& place, Registry& registry);

}  // namespace ppm
