#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

using FaceCorners = std::array<Eigen::Vector3f, 3>;  ///< m, map frame, counter-clockwise seen from free space

/// The corners of a face of a chunk.
FaceCorners face_corners(const Geometry& geometry, std::size_t f);
/// The unit normal of a triangle. Not finite where it has no area.
Eigen::Vector3f triangle_normal(const FaceCorners& corner);
/// Where texel (i, j) of a face with n divisions lies on it, m.
inline Eigen::Vector3f texel_place(const FaceCorners& corner, std::uint32_t n, std::uint32_t i, std::uint32_t j) {
  const float u = static_cast<float>(i) / static_cast<float>(n), v = static_cast<float>(j) / static_cast<float>(n);
  return corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
}

/// The surface that one face describes: its plane, moved along its normal by its texels' means. Beyond the face's sides
/// it goes on with the offset at the nearest point of them. For faces that move a little; faces that replace others
/// have TexelResampler, which sees all of them.
class DescribedFace {
 public:
  /// mean: [texel_count(divisions)] m, must outlive this.
  DescribedFace(const FaceCorners& corner, std::uint32_t divisions, std::span<const float> mean);

  /// How far along a unit direction, on the side of the normal (normal . direction > 0), the surface is from a point,
  /// m.
  float meet(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const;
  /// The means with which the same face, its corners moved, describes the same surface: each texel reads it where the
  /// line through it along the new normal meets it. mean: [texel_count(divisions)], not those that this reads.
  void reexpress(const FaceCorners& corner, std::span<float> mean) const;

 private:
  Eigen::Vector3f origin_, normal_, dual_u_, dual_v_;
  std::uint32_t divisions_;
  std::span<const float> mean_;
};

}  // namespace ppm
