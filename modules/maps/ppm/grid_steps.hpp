#pragma once
#include <array>
#include <cstdint>

#include "modules/maps/ppm/texel_grid.hpp"

namespace ppm {

/// Texels of one face each of 1, 2, .. divisions - 1 divisions.
constexpr std::uint32_t texels_of_fewer(std::uint32_t divisions) {
  return divisions * (divisions + 1) * (divisions + 2) / 6 - 1;
}

/// Faces with no more divisions have their texels' coordinates in a table.
constexpr std::uint32_t kTabledDivisions = 16;

/// Grid coordinates (i, j) of the texels of faces with up to kTabledDivisions divisions, one face after the other, each in the
/// order of texel_index; padded, so that whole vectors may be read from any texel on.
struct GridSteps {
  std::array<float, texels_of_fewer(kTabledDivisions + 1) + 16> i{}, j{};

  constexpr GridSteps() {
    for (std::uint32_t n = 1; n <= kTabledDivisions; ++n)
      for (std::uint32_t a = 0; a <= n; ++a)
        for (std::uint32_t b = 0; a + b <= n; ++b) {
          i[texels_of_fewer(n) + texel_index(n, a, b)] = static_cast<float>(a);
          j[texels_of_fewer(n) + texel_index(n, a, b)] = static_cast<float>(b);
        }
  }
};
inline constexpr GridSteps kGridSteps;

}  // namespace ppm
