#pragma once
#include <string>
#include <vector>

#include "modules/sources/analytic_scene.hpp"

namespace ppm {

/// Puts a scene together, object by object.
class SceneBuilder {
 public:
  /// Starts an object: solids added from here on are parts of it, in its frame.
  void begin_object(std::string name, const Eigen::Isometry3d& T_world_object = Eigen::Isometry3d::Identity());
  /// center: in the object's frame; R_object_local: the solid's axes there.
  void add(Solid::Shape shape, const Eigen::Vector3d& center, const Eigen::Vector3d& half,
           const Eigen::Vector3f& albedo, const Eigen::Matrix3d& R_object_local = Eigen::Matrix3d::Identity());
  /// Gives the solid that was added last a pattern.
  void paint(const Pattern& pattern);
  /// The scene of all that was added.
  AnalyticScene build() const { return {solids_, objects_}; }

 private:
  Eigen::Isometry3d T_world_object_ = Eigen::Isometry3d::Identity();
  std::vector<Solid> solids_;
  std::vector<SceneObject> objects_;
};

}  // namespace ppm
