#pragma once
#include <algorithm>

#include "framework/slam/rows.hpp"

namespace ppm {

/// Calls body(first, last) for bands of rows that cover [0, rows), in parallel; a band is large enough to be worth a
/// task.
template <class Body>
void for_row_bands(const Workers& workers, int rows, int cols, const Body& body) {
  constexpr int kPixels = 8192;  // about 50 us of work
  const int height = std::max(1, kPixels / std::max(1, cols));
  for_each_band(workers, rows, height, [&](const Rows& band) { body(band.first, band.end); });
}

}  // namespace ppm
