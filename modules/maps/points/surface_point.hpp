#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "framework/core/record.hpp"
#include "modules/maps/points/unit_normal.hpp"

namespace ppm {

/// A place on the surface: a small disc, what a point map knows of it. 32 bytes.
/// Source: Pfister et al., "Surfels: surface elements as rendering primitives", SIGGRAPH 2000; Keller et al., "Real-time
/// 3D reconstruction in dynamic scenes using point-based fusion", 3DV 2013.
struct SurfacePoint {
  Eigen::Vector3f position;  ///< m, map frame
  UnitNormal normal;         ///< towards where it was seen from
  float information = 0;     ///< 1/m^2 of the position along the normal, by the sensor's noise alone
  /// m^2 along the normal: how much more measurements scatter about the disc than position and sensor account for (poses,
  /// shape below the spacing). A running mean, signed.
  float scatter = 0;
  std::uint16_t radius = 0;   ///< of the disc, in steps of kRadiusStep_m
  std::uint16_t voxel = 0;    ///< where in its tile it was made, see PointTile
  std::uint16_t hits = 0;     ///< frames that measured it (saturating)
  std::uint16_t through = 0;  ///< frames that measured something behind it (saturating)

  static constexpr float kRadiusStep_m = 1e-4f;
  float radius_m() const { return static_cast<float>(radius) * kRadiusStep_m; }
  /// Up to 6.5 m.
  void set_radius(float r_m) {
    radius = static_cast<std::uint16_t>(std::clamp(std::round(r_m / kRadiusStep_m), 1.0f, 65535.0f));
  }
  /// Of the surface along the normal, m^2.
  float variance() const { return 1.0f / information + std::max(scatter, 0.0f); }
};
static_assert(sizeof(SurfacePoint) == 32, "saved and hashed as bytes: no padding");
template <>
struct IsPlain<SurfacePoint> : std::true_type {};

}  // namespace ppm
