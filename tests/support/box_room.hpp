#pragma once
#include "framework/slam/mesh.hpp"

namespace ppm::test {

/// The inside of a box [0, x] x [0, y] x [0, z]: floor, ceiling and walls, faces looking inwards, z upwards.
inline Mesh box_room(float x, float y, float z) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f p((i & 1) ? x : 0.0f, (i & 2) ? y : 0.0f, (i & 4) ? z : 0.0f);
    mesh.position.push_back(p);
    mesh.normal.push_back((Eigen::Vector3f(x, y, z) / 2 - p).normalized());
  }
  mesh.mean.assign(8, 0.0f);
  mesh.variance.assign(8, 1e-4f);
  // Each square counter-clockwise seen from inside.
  const std::uint32_t squares[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                       {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& s : squares) {
    mesh.face.push_back({s[0], s[1], s[2]});
    mesh.face.push_back({s[0], s[2], s[3]});
  }
  return mesh;
}

}  // namespace ppm::test
