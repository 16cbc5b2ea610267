#pragma once
#include <algorithm>

#include "framework/core/parallel.hpp"

namespace ppm {

/// Calls body(first, last) for bands of rows that cover [0, rows), in parallel; a band is large enough to be worth a
/// task.
template <class Body>
void for_row_bands(const Workers& workers, int rows, int cols, const Body& body) {
  constexpr int kPixels = 8192;  // about 50 us of work
  const int height = std::max(1, kPixels / std::max(1, cols)), bands = (rows + height - 1) / height;
  workers.for_each(static_cast<std::size_t>(bands), [&](std::size_t band, int) {
    const int first = static_cast<int>(band) * height;
    body(first, std::min(rows, first + height));
  });
}

}  // namespace ppm
