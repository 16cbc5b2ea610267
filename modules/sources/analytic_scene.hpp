#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "modules/sources/solid.hpp"
#include "modules/sources/solid_tree.hpp"

namespace ppm {

/// Where a ray meets a scene.
struct SceneHit {
  static constexpr std::uint32_t kNone = TreeHit::kNone;
  double range_m = std::numeric_limits<double>::infinity();  ///< along the ray; infinity = nothing hit
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();          ///< unit, out of the solid, world
  std::uint32_t solid = kNone;                               ///< index in solids()
};

/// An object, for people: a range of solids with a name.
struct SceneObject {
  std::string name;
  std::uint32_t first = 0, end = 0;
};

/// A world of solids, with exact answers to where a ray ends and how far the nearest surface is. Immutable. Solids may
/// touch and overlap. Made by SceneBuilder.
class AnalyticScene {
 public:
  AnalyticScene(std::vector<Solid> solids, std::vector<SceneObject> objects);

  /// The first surface that the ray enters. direction: unit. A ray that starts inside a solid does not see that solid.
  /// Where two surfaces coincide, the solid with the lower index is hit.
  SceneHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  /// The same among a few solids, for rays that are known to see no other.
  SceneHit cast_among(const std::vector<std::uint32_t>& among, const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction) const;
  /// Distance from a point to the nearest surface, m; negative inside a solid (where solids overlap, only the sign is
  /// exact).
  double distance(const Eigen::Vector3d& p) const;

  const std::vector<Solid>& solids() const { return solids_; }
  /// The object that a solid is part of.
  const SceneObject& object_of(std::uint32_t solid) const;

 private:
  SceneHit in_world(const TreeHit& best) const;

  std::vector<Solid> solids_;
  std::vector<SceneObject> objects_;
  SolidTree tree_;
};

}  // namespace ppm
