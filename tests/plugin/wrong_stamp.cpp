// A plug-in as an older ppm would have built it.
#include "framework/graph/registry.hpp"

extern "C" const char* ppm_plugin_abi() {
  return "ppm 0.0.1, headers 0123456789abcdef";
}
extern "C" void ppm_plugin_register(ppm::Registry&) {}
