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

 private:
  /// Turns normals from those of the map's elements to those of the described surface, as far as its neighbours in the view
  /// show it: not across the edges of things, where the two differ by more than kBend.
  void bend();
  /// One, by its neighbours `reach` pixels away.
  bool bend(int row, int col, int reach);
  static constexpr float kBend = 0.85f;  // cosine
  /// Far neighbours first: normals between near ones have the texels' noise, and a bare wall would hold by it.
  static constexpr int kReach = 3;
  std::vector<Texel> flat_;
};

}  // namespace ppm
