#pragma once
#include <vector>

#include "framework/slam/prediction.hpp"

namespace ppm {

/// The described surface that a view shows, as a registration reads it: point, normal and variance, pixel by pixel, in
/// the camera frame of the view.
struct SurfaceView {
  /// x, y, z of the surface, m; its unit normal, towards the camera; variance along it, m^2, by the map alone; `hit` is 1,
  /// or 0 where the map shows nothing, and all else is 0 there too.
  struct Texel {
    float x, y, z, nx, ny, nz, variance, hit;
  };
  Camera camera;
  Pose T_map_camera = Pose::Identity();
  std::vector<Texel> texels;  ///< [rows*cols], row-major

  /// Of a view whose arrays are filled. Keeps capacity.
  void build(const Prediction& view);
};

}  // namespace ppm
