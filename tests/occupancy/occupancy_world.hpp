#pragma once
#include <cmath>
#include <random>
#include <string>

#include "framework/slam/frame.hpp"
#include "modules/maps/vdb/occupancy_update.hpp"
#include "tests/support/plane_image.hpp"
#include "tests/support/workers.hpp"

namespace ppm::test {

using VdbPtr = std::shared_ptr<const VdbMap>;

inline std::string digest_of(const Map& map) {
  Digest digest;
  map.digest(digest);
  return digest.hex();
}

inline VdbPtr empty_grid(double voxel_size_m, float least = -4, float most = 6) {
  return std::make_shared<const VdbMap>(VdbSettings{voxel_size_m, least, most});
}

/// Half the edge of the box around the origin in which views are taken, m: its walls are no faces of voxels.
constexpr double kBox = 1.013;

/// Poses inside of the box that look about.
inline Pose pose_in_box(int number) {
  std::mt19937 random(static_cast<unsigned>(number));
  std::uniform_real_distribution<double> place(-0.4, 0.4), angle(-3, 3);
  return Eigen::Translation3d(place(random), place(random), place(random)) *
         Eigen::AngleAxisd(angle(random), Eigen::Vector3d(place(random), place(random), place(random)).normalized());
}

/// The box seen from a pose, with some pixels that see nothing and some that see something nearer.
inline Frame box_image(const Pose& T_map_camera, float sigma = 0.005f) {
  Frame frame;
  frame.camera = {48, 36, 40, 40, 23.5, 17.5};
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(0, 1);
  for (int i = 0; i < frame.camera.pixels(); ++i) {
    const Eigen::Vector3d ray = T_map_camera.linear() * frame.camera.ray(i % 48, i / 48);
    const Eigen::Vector3d from = T_map_camera.translation();
    const Eigen::Vector3d wall = kBox * (ray.array() > 0).select(Eigen::Vector3d::Ones(), -Eigen::Vector3d::Ones());
    const double depth = ((wall - from).array() / ray.array()).minCoeff();
    const float chance = any(random);
    frame.depth.push_back(chance < 0.03f ? kNoReturn : static_cast<float>(depth * (chance < 0.06f ? 0.5 : 1)));
  }
  frame.sigma.assign(frame.depth.size(), sigma);
  return frame;
}

/// The grid after a frame.
inline VdbPtr after(VdbPtr map, const Frame& frame, const Pose& T_map_camera, const OccupancySettings& settings = {},
                    const Workers& workers = one_worker()) {
  OccupancyView view;
  view.build(frame, *map, settings);
  return update_occupancy(std::move(map), view, T_map_camera, workers);
}

/// The grid after views of the box.
inline VdbPtr box_map(VdbPtr map, int first, int last, const OccupancySettings& settings = {},
                      const Workers& workers = one_worker()) {
  for (int i = first; i < last; ++i)
    map = after(std::move(map), box_image(pose_in_box(i)), pose_in_box(i), settings, workers);
  return map;
}

}  // namespace ppm::test
