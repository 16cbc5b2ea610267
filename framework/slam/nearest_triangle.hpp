#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace ppm {

/// Answers how far points are from the surface that triangles make. Immutable: any thread may ask. A face may be
/// degenerate, a line or a point. A tree of boxes over copies of the corners: about 60 bytes a face.
class NearestTriangle {
 public:
  using Face = std::array<std::uint32_t, 3>;
  /// position: m, finite; face: indices of position.
  NearestTriangle(const std::vector<Eigen::Vector3f>& position, const std::vector<Face>& face);

  /// Distance from a point to the nearest point of any triangle, m; infinity where there is no triangle.
  double distance(const Eigen::Vector3f& p) const;
  bool empty() const { return triangles_.empty(); }

 private:
  using Triangle = std::array<Eigen::Vector3f, 3>;
  /// The first child of an inner node follows it.
  struct Node {
    Eigen::AlignedBox3f box;
    std::uint32_t count = 0;  // leaf: of triangles; inner: 0
    std::uint32_t at = 0;     // leaf: first of triangles_; inner: second child
  };
  void build(std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;  // leaf by leaf
  std::vector<Node> nodes_;
};

/// Square of the distance from a point to a triangle, which may be degenerate.
float squared_distance(const Eigen::Vector3f& p, const std::array<Eigen::Vector3f, 3>& triangle);

}  // namespace ppm
