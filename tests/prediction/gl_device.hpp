#pragma once
#include <string>

#include "framework/core/error.hpp"
#include "modules/prediction/gl_context.hpp"

namespace ppm::test {

/// Why OpenGL cannot draw on this machine; empty where it can.
inline const std::string& gl_lacks() {
  static const std::string reason = [] {
    try {
      const GlContext context(GlDevice::any);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  }();
  return reason;
}

}  // namespace ppm::test
