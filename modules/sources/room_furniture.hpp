#pragma once
#include "modules/sources/analytic_scene.hpp"

namespace ppm {

/// Pieces of furniture, each added as one object with the things that lie on it. Object frame: origin on the floor in the middle
/// of the piece (for things on a wall: on the wall), z up, front towards +x. Sizes are those of ordinary furniture.
void add_sofa(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_armchair(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_coffee_table(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_bookshelf(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_sideboard(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_dining_table(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_chair(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_floor_lamp(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_plant(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_coat_stand(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_door(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
void add_window(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object);
/// A framed picture of the given size on a wall, with a simple landscape.
void add_picture(AnalyticScene& scene, const Eigen::Isometry3d& T_world_object, double width, double height);

}  // namespace ppm
