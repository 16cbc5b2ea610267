#pragma once
#include <cstdint>
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Which pixels of a predicted image are compared with the measured one: a regular grid.
struct PixelGrid {
  int step = 1;                  ///< every step-th column and row of the predicted image
  int first_x = 0, first_y = 0;  ///< in [0, step)
  double jump_m = 0;  ///< pixels where the measured depth departs from a plane through its neighbours by more are left
                      ///< out; 0: none is
};

/// The measured pixels of a frame that a likelihood looks at, as a structure of arrays; one entry a pixel with a
/// return, row-major.
struct MeasuredPixels {
  std::vector<std::uint32_t> pixel;  ///< index into the arrays of the Prediction
  std::vector<std::uint32_t> source;  ///< index into the arrays of the Frame
  std::vector<float> range;          ///< m along the ray
  std::vector<float> variance;       ///< m^2 of the range
  std::vector<float> lateral;        ///< m, standard deviation across the ray (Frame::lateral_px at this depth)
  std::size_t size() const { return pixel.size(); }
};

/// True where the depth at pixel (x, y), which has one, is off the plane through its two neighbours, along the row or the
/// column, by more than jump_m and what the sensor's noise explains. Planes are linear in disparity, so a slope is no jump.
bool at_depth_jump(const Frame& frame, int x, int y, double jump_m);

/// predicted: camera of the Prediction, the frame's decimated by `stride`.
MeasuredPixels measured_pixels(const Frame& frame, const Camera& predicted, int stride, const PixelGrid& grid);

}  // namespace ppm
