#pragma once
#include <unordered_map>

#include "modules/maps/octomap/octomap_ray.hpp"

namespace ppm {

/// Where the surface is taken to be, at the first occupied cell of a ray: an octree of occupancies says no more than that
/// it is there.
enum class OctomapPlace {
  centre,  ///< the range of its centre: OcTree::castRay
  face,    ///< where the ray enters it: OcTree::getRayIntersection
  middle,  ///< halfway through the run of occupied cells along the ray that begins with it
};

/// Reads surfaces off one tree. One a thread.
class OctomapSurface {
 public:
  OctomapSurface(const octomap::OcTree& tree, OctomapPlace place);
  struct Point {
    double range_m = 0;
    Eigen::Vector3f normal;  ///< unit, against the gradient of occupancy; zero where that vanishes
  };
  /// What a ray shows. direction: unit.
  std::optional<Point> look(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double range_most_m);

 private:
  const Eigen::Vector3f& normal_of(const OctomapCell& cell);

  const octomap::OcTree& tree_;
  OctomapPlace place_;
  OctomapLookup lookup_;
  std::unordered_map<std::uint64_t, Eigen::Vector3f> normals_;  // by cell: many pixels see the same
};

}  // namespace ppm
