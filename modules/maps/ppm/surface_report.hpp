#pragma once
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/slam/camera.hpp"
#include "framework/slam/trajectory.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// Whether a map is one sound layer of surface.
struct SurfaceReport {
  double area_m2 = 0;
  std::size_t faces = 0;
  std::size_t boundary_edges = 0;      ///< with one face
  std::size_t non_manifold_edges = 0;  ///< with more than two faces, or with two that wind alike
  std::size_t rays = 0;                ///< random rays that met a surface
  std::size_t second_layers = 0;       ///< of them, those that met a second layer

  double boundary_edges_per_m2() const { return area_m2 > 0 ? static_cast<double>(boundary_edges) / area_m2 : 0; }
  double second_layer_share() const {
    return rays > 0 ? static_cast<double>(second_layers) / static_cast<double>(rays) : 0;
  }
};

/// Random rays: through random points of the image, from random poses of the path. A ray meets a second layer where
/// from 2 mm to 5 cm behind its first hit there is another face whose normal is within 45 degrees of the first one's.
SurfaceReport report_surface(const PpmMap& map, const Camera& camera, const std::vector<StampedPose>& path, int rays,
                             Rng rng);

}  // namespace ppm
