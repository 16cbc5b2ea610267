#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ppm {

/// A closed solid with an exact surface. Local axes: a box has half sizes half.xyz; a cylinder stands on its local z with radius
/// half.x and half height half.z, with flat ends; a sphere has radius half.x.
struct Solid {
  enum class Shape { box, cylinder, sphere };
  Shape shape = Shape::box;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();         ///< m, world
  Eigen::Matrix3d R_world_local = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);    ///< m
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.6f);  ///< reflectance of red, green, blue in [0, 1]
};

/// Where a ray meets a scene.
struct SceneHit {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  double range_m = std::numeric_limits<double>::infinity();  ///< along the ray; infinity = nothing hit
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();           ///< unit, out of the solid, world
  std::uint32_t solid = kNone;                                ///< index in solids()
};

/// A world of solids, with exact answers to where a ray ends and how far the nearest surface is. Solids may touch and overlap.
/// Solids are added object by object (a chair, a lamp), which also makes casting fast: an object whose box is missed is skipped.
class AnalyticScene {
 public:
  /// Starts an object: solids added from here on are parts of it, in its frame.
  void begin_object(std::string name, const Eigen::Isometry3d& T_world_object = Eigen::Isometry3d::Identity());
  /// center: in the object's frame; R: the solid's axes there.
  void add(Solid::Shape shape, const Eigen::Vector3d& center, const Eigen::Vector3d& half, const Eigen::Vector3f& albedo,
           const Eigen::Matrix3d& R_object_local = Eigen::Matrix3d::Identity());

  /// The first surface that the ray enters. direction: unit. A ray that starts inside a solid does not see that solid.
  SceneHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  /// Distance from a point to the nearest solid, m; negative inside one (then only its sign is exact).
  double distance(const Eigen::Vector3d& p) const;

  const std::vector<Solid>& solids() const { return solids_; }
  /// Name of the object that a solid belongs to.
  const std::string& object_name(std::uint32_t solid) const;

 private:
  struct Object {
    std::string name;
    Eigen::Isometry3d T_world_object;
    std::uint32_t first = 0, end = 0;  // of solids_
    Eigen::AlignedBox3d box;           // world
  };
  std::vector<Object> objects_;
  std::vector<Solid> solids_;
};

}  // namespace ppm
