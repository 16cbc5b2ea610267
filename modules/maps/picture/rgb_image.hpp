#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ppm {

/// Red, green, blue in [0, 1], as displayed (sRGB).
using Color = Eigen::Vector3f;

inline std::array<std::uint8_t, 3> to_bytes(const Color& color) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t k = 0; k < 3; ++k)
    bytes[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[static_cast<Eigen::Index>(k)], 0.0f, 1.0f)));
  return bytes;
}

struct RgbImage {
  int cols = 0, rows = 0;
  std::vector<std::uint8_t> rgb;  ///< [rows*cols*3], row-major
};

}  // namespace ppm
