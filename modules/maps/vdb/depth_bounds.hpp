#pragma once
#include <cstddef>
#include <vector>

#include "modules/maps/vdb/occupancy_model.hpp"

namespace ppm {

/// Pixels x0 .. x1, y0 .. y1, both ends included.
struct PixelRect {
  int x0, y0, x1, y1;
};

/// How far rectangles of an image are free, and how far they say anything: answered from a pyramid, by bounds that are
/// never too tight.
/// Source: the min-max image of Reijgwart et al., "Efficient volumetric mapping of multi-scale environments using
/// wavelet-based compression", RSS 2023.
class DepthBounds {
 public:
  struct Bounds {
    float free;           ///< what is not deeper is free in all pixels; -inf where one has no measurement
    float measured_free;  ///< the same, of those with a measurement; +inf without any
    float end;            ///< nothing is said of what is deeper; -inf without any
  };
  void build(const PixelProfiles& profiles);
  /// rect: within the image.
  Bounds of(const PixelRect& rect) const;

 private:
  struct Level {
    int cols = 0, rows = 0;
    std::vector<Bounds> bounds;  // [rows*cols] of squares of 2^level pixels
  };
  std::vector<Level> levels_;
};

}  // namespace ppm
