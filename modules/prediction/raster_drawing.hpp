#pragma once
#include <cstdint>
#include <vector>

#include "modules/prediction/raster_view.hpp"

namespace ppm {

/// Memory for drawing, one a worker.
struct RasterScratch {
  struct Chunk {
    std::uint32_t number;
    float distance;  ///< m^2, squared, from the camera's centre to the chunk's box
  };
  std::vector<Chunk> chunks;
  AlignedArray<float> vertex;         ///< see raster_project
  AlignedArray<float> inverse_depth;  ///< see raster_draw
  RasterBoxes boxes;
};

/// Draws rows of a view that was started: chunks in the image, nearest first. A pure function of its arguments: the
/// same pixels each time, however rows are grouped.
void draw_rows(const Rows& rows, RasterView& view, RasterScratch& scratch);

}  // namespace ppm
