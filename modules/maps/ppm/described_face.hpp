#pragma once
#include <array>
#include <cstdint>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {

using FaceCorners = std::array<Eigen::Vector3f, 3>;  ///< m, map frame, counter-clockwise seen from free space

/// The unit normal of a triangle. Not finite where it has no area.
Eigen::Vector3f triangle_normal(const FaceCorners& corner);
/// Where texel (i, j) of a face with n divisions lies on it, m.
inline Eigen::Vector3f texel_place(const FaceCorners& corner, std::uint32_t n, std::uint32_t i, std::uint32_t j) {
  const float u = static_cast<float>(i) / static_cast<float>(n), v = static_cast<float>(j) / static_cast<float>(n);
  return corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
}
/// The corners of a face of a chunk.
FaceCorners face_corners(const Geometry& geometry, std::size_t f);

/// The surface that one face describes: its plane, moved along its normal by its texels. Beyond the face's sides it goes
/// on with the offset at the nearest point of them.
class DescribedFace {
 public:
  /// texels: [texel_count(divisions)], must outlive this.
  DescribedFace(const FaceCorners& corner, std::uint32_t divisions, const TexelView& texels);

  const Eigen::Vector3f& normal() const { return normal_; }
  struct Meeting {
    float along;       ///< m, from the line's point
    TexelTriangle at;  ///< the texels around the point of the face below the meeting
  };
  /// Where the line through a point, along a unit direction on the side of the normal (normal . direction > 0), meets the surface.
  Meeting meet(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const;

  /// Appends the texels with which a face with other corners describes the same surface: each reads it where the line
  /// through it along the new face's normal meets it. Variances and colours are interpolated there like the means.
  void reexpress(const FaceCorners& corner, std::uint32_t divisions, TexelArrays& texels) const;
  /// The means alone, for a face with as many divisions whose corners have moved a little [texel_count(divisions)].
  void reexpress_means(const FaceCorners& corner, std::span<float> mean) const;

 private:
  Eigen::Vector3f origin_, normal_, dual_u_, dual_v_;
  std::uint32_t divisions_;
  TexelView texels_;
};

}  // namespace ppm
