#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// Triangles with shared vertices, for making maps of known shape.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> position;           ///< [V] m, map frame
  std::vector<std::array<std::uint32_t, 3>> face;  ///< [F] counter-clockwise seen from free space
};

/// The mesh as a map whose texels say mean_of(point), m along the face normal, with that variance, m^2. The settings
/// must ask for no colour.
std::shared_ptr<const PpmMap> map_of(const TriangleMesh& mesh, const PpmSettings& settings,
                                     const std::function<float(const Eigen::Vector3f&)>& mean_of, float variance);

}  // namespace ppm
