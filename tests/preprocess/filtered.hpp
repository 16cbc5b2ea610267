#pragma once
#include <string>

#include "framework/graph/harness.hpp"
#include "tests/support/plane_image.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {

/// What a module makes of a frame.
inline std::shared_ptr<const Frame> filtered(const std::string& module, const std::string& params, const Frame& frame,
                                             int threads = 1) {
  Harness h(builtin(), module, params, threads);
  h.input("frame", std::make_shared<const Frame>(frame));
  h.tick();
  return h.output<Frame>("frame");
}

/// Of pixels that are dropped in `out` and not in `in`.
inline std::vector<std::size_t> dropped(const Frame& in, const Frame& out) {
  std::vector<std::size_t> pixels;
  for (std::size_t p = 0; p < in.depth.size(); ++p)
    if (!std::isnan(in.depth[p]) && std::isnan(out.depth[p])) pixels.push_back(p);
  return pixels;
}

}  // namespace ppm::test
