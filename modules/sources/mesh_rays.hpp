#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "modules/sources/triangle_mesh.hpp"

namespace ppm {

/// Where a ray meets a mesh.
struct MeshHit {
  float range_m = std::numeric_limits<float>::infinity();  ///< along the ray; infinity = nothing hit
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();         ///< unit, of the triangle, towards the ray's origin
};

/// Answers where rays end in a mesh; both sides of a triangle are seen. Immutable: any thread may cast.
class MeshRays {
 public:
  /// Throws Error where Embree cannot start.
  explicit MeshRays(const TriangleMesh& mesh);
  ~MeshRays();
  MeshRays(const MeshRays&) = delete;
  MeshRays& operator=(const MeshRays&) = delete;

  /// direction: [n] unit, of rays from one point; hit: [n], written. Neighbours in the list should be neighbours in space:
  /// sixteen rays are cast at once.
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction, std::span<MeshHit> hit) const;

 private:
  struct Scene;
  std::unique_ptr<const Scene> scene_;
};

}  // namespace ppm
