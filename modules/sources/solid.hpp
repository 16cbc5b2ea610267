#pragma once
#include <Eigen/Geometry>
#include <limits>

namespace ppm {

/// A pattern in a second colour, carved through the solid: cells of size.x by size.y by size.z in its local axes, every
/// second one, like a chessboard's, in that colour. An infinite size makes stripes or boards.
struct Pattern {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m; all 0: none
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();
};

/// A closed solid with an exact surface. Local axes: a box has half sizes half.xyz; a cylinder stands on its local z
/// with radius half.x = half.y and half height half.z, with flat ends; a sphere has radius half.x = half.y = half.z.
struct Solid {
  enum class Shape { box, cylinder, sphere };
  Shape shape = Shape::box;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Matrix3d R_world_local = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);     ///< m
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.6f);  ///< reflectance of red, green, blue in [0, 1]
  Pattern pattern = {};                                      ///< seen by colour cameras alone
};

/// Where a ray enters a solid.
struct SolidHit {
  double range_m = std::numeric_limits<double>::infinity();  ///< along the ray; infinity = it does not
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();          ///< unit, outwards, in the solid's local axes
};

/// direction: unit. A ray that starts inside does not enter.
SolidHit enter(const Solid& solid, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
/// Exact distance from a point to the surface, m; negative inside.
double signed_distance(const Solid& solid, const Eigen::Vector3d& p_world);
/// Reflectance at a point of the surface, with the pattern.
Eigen::Vector3f albedo_at(const Solid& solid, const Eigen::Vector3d& p_world);
/// The smallest box around it in world axes, for a cylinder nearly so.
Eigen::AlignedBox3d bounds(const Solid& solid);

}  // namespace ppm
