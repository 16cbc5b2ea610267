#pragma once
#include "framework/graph/registry.hpp"
#include "modules/builtin.hpp"

namespace ppm::test {

/// The registry with every built-in module.
inline const Registry& builtin() {
  static const Registry registry = [] {
    Registry r;
    register_builtin(r);
    return r;
  }();
  return registry;
}

}  // namespace ppm::test
