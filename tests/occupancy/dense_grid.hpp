#pragma once
#include <cmath>
#include <vector>

#include "modules/maps/vdb/occupancy_model.hpp"

namespace ppm::test {

/// The oracle: every voxel of a cube in one array, and each looks at the image by itself. In plain double precision.
class DenseGrid {
 public:
  /// Voxels -n .. n-1 along each axis.
  DenseGrid(int n, double voxel_size_m, double least, double most)
      : n_(n), h_(voxel_size_m), least_(least), most_(most), value_(static_cast<std::size_t>(8 * n * n * n), NAN) {}

  double& at(int x, int y, int z) {
    return value_[static_cast<std::size_t>(((x + n_) * 2 * n_ + y + n_) * 2 * n_ + z + n_)];
  }

  void update(const Frame& frame, const Pose& T_map_camera, const OccupancySettings& s) {
    const Pose T_camera_map = T_map_camera.inverse();
    for (int x = -n_; x < n_; ++x)
      for (int y = -n_; y < n_; ++y)
        for (int z = -n_; z < n_; ++z) {
          const Eigen::Vector3d p = T_camera_map * (h_ * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
          if (p.z() <= 0) continue;
          const Eigen::Vector2d at_image = frame.camera.project(p);
          const int column = static_cast<int>(std::lround(at_image.x())), row = static_cast<int>(std::lround(at_image.y()));
          if (column < 0 || row < 0 || column >= frame.camera.cols || row >= frame.camera.rows) continue;
          const auto i = static_cast<std::size_t>(row * frame.camera.cols + column);
          if (std::isnan(frame.depth[i])) continue;
          add(at(x, y, z), frame, i, frame.camera.ray(column, row).norm(), p.z(), s);
        }
  }

 private:
  /// depth: of the voxel; along: range over depth on the pixel's ray.
  void add(double& value, const Frame& frame, std::size_t i, double along, double depth, const OccupancySettings& s) {
    const double sigma = along * frame.sigma[i];
    const double width = std::max(s.width_sigmas * sigma, s.width_voxels * h_);
    double behind = along * (depth - frame.depth[i]);  // of the surface
    double evidence = 0;
    if (along * frame.depth[i] > s.max_range_m) {
      if (along * depth > s.max_range_m) return;
      evidence = s.log_odds_miss;
    } else {
      if (behind > std::max(s.thickness_voxels * h_, width)) return;
      evidence = (s.log_odds_hit - s.log_odds_miss) / 2 * behind / width;
      evidence = std::min(std::max<double>(evidence, s.log_odds_miss), static_cast<double>(s.log_odds_hit));
    }
    const double before = std::isnan(value) ? 0 : value;
    const double keep = s.memory > 0 ? std::exp(-1 / s.memory) : 1;
    value = std::min(std::max(keep * before + evidence, least_), most_);
  }

  int n_;
  double h_, least_, most_;
  std::vector<double> value_;
};

}  // namespace ppm::test
