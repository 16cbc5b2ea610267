#include "framework/graph/plugin.hpp"

#include <dlfcn.h>

#include "framework/graph/abi.hpp"
#include "framework/graph/shipped_plugins.hpp"

namespace ppm {

namespace {

/// Binds lazily at first: a library made for other headers may lack symbols, and its stamp tells more than the first of
/// them.
void* open_library(const std::filesystem::path& file, int binding, const Place& place) {
  void* library = dlopen(file.c_str(), binding | RTLD_LOCAL);
  if (!library) throw ConfigError(place, fmt::format("plug-in cannot be loaded: {}", dlerror()));
  return library;
}

template <class Function>
Function* find_function(void* library, const char* name, const std::filesystem::path& file, const Place& place) {
  void* symbol = dlsym(library, name);
  if (!symbol) {
    throw ConfigError(place, fmt::format("{} is no ppm plug-in: it has no function '{}'", file.string(), name));
  }
  return reinterpret_cast<Function*>(symbol);
}

void check_stamp(const std::string& stamp, const std::filesystem::path& file, const Place& place) {
  if (stamp == PPM_ABI_STAMP) return;
  throw ConfigError(place,
                    fmt::format("plug-in {} was built for another ppm; build it again\n  plug-in: {}\n  ppm:     {}",
                                file.string(), stamp, PPM_ABI_STAMP));
}

std::filesystem::path file_of(const std::filesystem::path& library, const Place& place) {
  if (is_plugin_name(library.string())) {
    try {
      return std::filesystem::canonical(library_of(library.string(), shipped_plugins()));
    } catch (const Error& e) {
      throw ConfigError(place, e.what());
    }
  }
  if (!std::filesystem::exists(library)) throw ConfigError(place, fmt::format("no plug-in {}", library.string()));
  return std::filesystem::canonical(library);
}

}  // namespace

void load_plugin(const std::filesystem::path& library, const Place& place, Registry& registry) {
  const auto file = file_of(library, place);
  for (const auto* info : registry.all()) {
    if (info->origin == file.string()) return;  // named twice
  }
  void* handle = open_library(file, RTLD_LAZY, place);
  check_stamp(find_function<const char*()>(handle, "ppm_plugin_abi", file, place)(), file, place);
  open_library(file, RTLD_NOW, place);  // a symbol that is missing is found now, not in the middle of a run
  auto* add_modules = find_function<void(Registry&)>(handle, "ppm_plugin_register", file, place);

  Registry added;
  added.set_origin(file.string());
  try {
    add_modules(added);
  } catch (const InternalError& e) {
    throw ConfigError(place, fmt::format("plug-in {}: {}", file.string(), e.what()));
  }
  for (const auto* info : added.all()) {
    if (const auto* taken = registry.find(info->name)) {
      throw ConfigError(place, fmt::format("plug-in {}: module '{}' is there already ({})", file.string(), info->name,
                                           taken->origin));
    }
  }
  for (const auto& [kind, codec] : added.map_kinds()) {
    if (registry.map_kinds().contains(kind))
      throw ConfigError(place, fmt::format("plug-in {}: maps of kind '{}' are known already", file.string(), kind));
  }
  for (const auto* info : added.all()) registry.add(*info);
  for (const auto& [kind, codec] : added.map_kinds()) registry.add_map_kind(kind, codec);
}

}  // namespace ppm
