#pragma once
#include <cstddef>
#include <cstdint>

namespace ppm {

/// A row of a view beside the measured image.
struct ElementRow {
  const std::uint32_t *chunk = nullptr, *face = nullptr;  ///< [pixels], see Prediction
  const float* depth = nullptr;                           ///< of pixel x at x * depth_step; NaN = no return
  std::size_t depth_step = 1, pixels = 0;
};

struct RowCounts {
  std::size_t starts = 0;  ///< pixels that show another element than the one before them, the first one too
  std::size_t measured = 0, missed = 0;  ///< pixels with a measurement; those of them where the view shows nothing
};

/// Counts, and writes the starts, ascending, to `starts`, which has room for kStartsPad more than the row's pixels.
/// Same on every processor.
RowCounts read_row(const ElementRow& row, std::uint32_t* starts);
inline constexpr std::size_t kStartsPad = 16;

}  // namespace ppm
