#pragma once
#include "modules/sources/scene_builder.hpp"

namespace ppm {

/// Pieces of furniture, each added as one object with the things that lie on it. Object frame: origin on the floor in
/// the middle of the piece (for things on a wall: on the wall), z up, front towards +x. Sizes are those of ordinary
/// furniture.
void add_sofa(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_armchair(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_coffee_table(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_bookshelf(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_sideboard(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_dining_table(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_chair(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_floor_lamp(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_plant(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_coat_stand(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_door(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
void add_window(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object);
/// A framed picture of the given size on a wall, with a simple landscape.
void add_picture(SceneBuilder& scene, const Eigen::Isometry3d& T_world_object, double width, double height);

}  // namespace ppm
