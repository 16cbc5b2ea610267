#pragma once
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "framework/slam/mesh.hpp"

namespace ppm {

/// A camera somewhere in the map frame.
struct View {
  Camera camera;
  Pose T_map_camera = Pose::Identity();
};

/// Upwards in the map frame: against the y axes of the cameras on the path (image rows grow downwards), made exact by
/// the floors, table tops and ceilings among the faces that agree with it to 45 degrees. Unit.
Eigen::Vector3d estimate_up(const Mesh& mesh, const std::vector<Pose>& path);

/// A view of the whole map from outside and above, so turned that most surface is seen from its front.
/// azimuth_rad: from the direction of the walls, in whichever quarter shows most; elevation_rad: above the horizon.
View overview(const Mesh& mesh, const std::vector<Pose>& path, const Eigen::Vector3d& up, double azimuth_rad,
              double elevation_rad, int cols, int rows);

}  // namespace ppm
