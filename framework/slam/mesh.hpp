#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ppm {

/// A triangle mesh for export and display. Faces wind counter-clockwise seen from outside (from where the camera was).
struct Mesh {
  std::vector<Eigen::Vector3f> position;  ///< m, map frame
  std::vector<Eigen::Vector3f> normal;    ///< unit, per vertex
  std::vector<float> mean;                ///< m along the normal, per vertex
  std::vector<float> variance;            ///< m^2, per vertex
  std::vector<Eigen::Vector3f> color;     ///< RGB in [0, 1] as displayed, per vertex; empty where the map has none
  std::vector<std::array<std::uint32_t, 3>> face;
};

}  // namespace ppm
