#pragma once
#include <iostream>
#include <string>

#include "framework/graph/plugin.hpp"
#include "framework/graph/shipped_plugins.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {

/// Whether a plug-in that ships was built; says so, visibly, where it was not.
inline bool built(const std::string& name) {
  for (const auto& plugin : shipped_plugins()) {
    if (plugin.name != name) continue;
    if (!plugin.built) std::cout << "SKIPPED: plug-in '" << name << "' needs the package " << plugin.package << "\n";
    return plugin.built;
  }
  return false;
}

/// Whether all of them were built.
inline bool all_built() {
  bool all = true;
  for (const auto& plugin : shipped_plugins()) all = built(plugin.name) && all;
  return all;
}

/// The built-in modules, and those of the plug-ins that ship and were built.
inline const Registry& shipped() {
  static const Registry registry = [] {
    Registry r;
    register_builtin(r);
    for (const auto& plugin : shipped_plugins())
      if (plugin.built) load_plugin(plugin.name, {}, r);
    return r;
  }();
  return registry;
}

}  // namespace ppm::test
