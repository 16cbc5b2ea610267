#pragma once
#include <cstddef>
#include <vector>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Unit normal of the measured surface at a pixel that has a return, camera frame, towards the camera: of the plane through
/// the neighbours `reach` pixels away. Zero where one of them is beyond the image, has no return or lies across a jump.
Eigen::Vector3f measured_normal(const Frame& frame, int x, int y, int reach, double jump_m);

/// The points of a frame that are laid onto a predicted surface, coarse to fine: each level a regular grid of pixels, as a
/// structure of arrays, row-major; pixels without a return, beside a depth jump, or without a normal are left out.
/// Camera frame, m.
struct MeasuredSurface {
  struct Level {
    int step = 1;                              ///< of the grid, frame pixels
    std::vector<float> x, y, z;                ///< point
    std::vector<float> nx, ny, nz;             ///< unit normal of the measured surface, towards the camera
    std::vector<float> variance;               ///< m^2 of the depth
    std::size_t size() const { return x.size(); }
  };
  std::vector<Level> levels;  ///< coarse to fine
  std::size_t measured = 0;   ///< pixels of the finest grid with a return, jumps among them

  /// steps: of the grids, coarse to fine. jump_m: see PixelGrid. Normals are of the plane through the neighbours at
  /// half the finest step, at least one pixel.
  void build(const Frame& frame, const std::vector<int>& steps, double jump_m);
};

}  // namespace ppm
