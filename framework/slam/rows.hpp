#pragma once
#include <algorithm>
#include <cstddef>

#include "framework/core/parallel.hpp"

namespace ppm {

/// Some rows of an image: first, first + 1, .. end - 1.
struct Rows {
  int first = 0, end = 0;
};

/// Calls body(Rows) once for each band of rows of an image, one to a worker's turn; all bands are `height` rows high
/// but the last.
template <class Body>
void for_each_band(const Workers& workers, int rows, int height, const Body& body) {
  workers.for_each(static_cast<std::size_t>((rows + height - 1) / height), [&](std::size_t band, int) {
    const int first = static_cast<int>(band) * height;
    body(Rows{first, std::min(first + height, rows)});
  });
}

/// Rows of a band, where nothing else decides: enough work for a turn, few enough for their pixels to stay in cache.
constexpr int kBandRows = 16;

}  // namespace ppm
