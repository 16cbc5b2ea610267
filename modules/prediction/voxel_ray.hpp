#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "modules/prediction/voxel_leaves.hpp"

namespace ppm {

/// What is taken for the surface that a ray meets.
enum class VoxelSurface {
  crossing,  ///< where the log odds, linear between the centres of voxels, first rise above 0
  cell,      ///< the centre of the first voxel above 0
  expected,  ///< the mean over the voxels around it, each weighted by its probability of being the first that is occupied
};

struct VoxelRayOptions {
  VoxelSurface surface = VoxelSurface::crossing;
  float cell_sigma = 0.2f;    ///< voxels: standard deviation beside that of the log odds' profile
  float normal_reach = 1.5f;  ///< voxels between the samples of the gradient and the surface
};

/// A ray through voxels. All lengths in voxels; voxel (i, j, k) covers [i, i+1) and so on.
struct VoxelRay {
  Eigen::Vector3f origin, direction;  ///< direction: unit, no component 0
  Eigen::Vector3f inverse;            ///< 1 / direction, component by component
  float from = 0, to = 0;             ///< the part that is looked at

  /// A direction's components that are too small to divide by become 1e-6.
  static VoxelRay make(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction);
  /// Shortens it to a box; false where it misses the box.
  bool clip(const Eigen::Array3f& low, const Eigen::Array3f& high);
  Eigen::Vector3f at(float t) const { return origin + t * direction; }
};

/// What a ray meets. Lengths in voxels.
struct VoxelHit {
  float range = std::numeric_limits<float>::infinity();  ///< infinite: nothing
  float variance = 0;                                    ///< of the range
  Cell voxel{0, 0, 0};                                   ///< the first that is rather occupied
  std::uint32_t chunk = 0xffffffffu;
  bool hit() const { return range < std::numeric_limits<float>::infinity(); }
};

/// Follows a ray from leaf to leaf that holds nothing occupied, and from voxel to voxel in those that do.
/// start: where the walk begins, not beyond the first occupied voxel.
/// Source: Amanatides, Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987; Museth, "Hierarchical
/// digital differential analyzer for efficient ray-marching in OpenVDB", SIGGRAPH 2014 talks.
VoxelHit trace(const VoxelRay& ray, const VoxelRayOptions& options, VoxelLeaves& leaves, float start = 0);

/// Unit normal of the surface at a hit, towards the ray's origin: down the log odds; against the ray where they are level.
Eigen::Vector3f normal_of(const VoxelRay& ray, const VoxelHit& hit, const VoxelRayOptions& options, VoxelLeaves& leaves);

}  // namespace ppm
