#include "modules/sources/scene_builder.hpp"

#include <utility>

#include "framework/core/error.hpp"

namespace ppm {

void SceneBuilder::begin_object(std::string name, const Eigen::Isometry3d& T_world_object) {
  const auto n = static_cast<std::uint32_t>(solids_.size());
  objects_.push_back({std::move(name), n, n});
  T_world_object_ = T_world_object;
}

void SceneBuilder::add(Solid::Shape shape, const Eigen::Vector3d& center, const Eigen::Vector3d& half,
                       const Eigen::Vector3f& albedo, const Eigen::Matrix3d& R_object_local) {
  PPM_CHECK(!objects_.empty(), "begin_object() comes first");
  solids_.push_back({shape, T_world_object_ * center, T_world_object_.linear() * R_object_local, half, albedo});
  objects_.back().end = static_cast<std::uint32_t>(solids_.size());
}

void SceneBuilder::paint(const Pattern& pattern) {
  PPM_CHECK(!solids_.empty(), "add() comes first");
  solids_.back().pattern = pattern;
}

}  // namespace ppm
