#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"
#include "tests/prediction/ray_oracle.hpp"

namespace ppm::test {

/// The oracle's answer for many rays: all faces of a map in double precision, in a tree of boxes that leaves out of a
/// ray's way only what its box is out of the way. A face is met on its edges too; one seen from behind is not there
/// unless back faces are to be hit.
class FaceTree {
 public:
  explicit FaceTree(const PpmMap& map, bool cull_back_faces = true);
  bool culls_back_faces() const { return cull_; }

  /// The nearest crossing beyond a range of `from`; range INFINITY where there is none. direction: unit.
  OracleHit nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from = 0) const;
  /// All crossings, unordered.
  std::vector<OracleHit> all(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  struct Face {
    std::uint32_t chunk, face;
    Eigen::Vector3d p0, e1, e2;
  };
  struct Box {
    Eigen::AlignedBox3d bounds;
    std::uint32_t first = 0, end = 0;  // faces of a leaf
    std::uint32_t right = 0;           // the second child, 0 at a leaf; the first one follows the box
  };
  void split(std::uint32_t first, std::uint32_t end);
  template <class Meet>
  void visit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, const double& limit, Meet meet) const;

  bool cull_;
  std::vector<Face> faces_;
  std::vector<Box> boxes_;
};

}  // namespace ppm::test
