#pragma once
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// How far the rays of a view go before they can meet anything, for blocks of kBlock x kBlock pixels: the nearest leaf that
/// holds an occupied voxel and may show in the block. Spares rays the walk through free space.
class RayStarts {
 public:
  static constexpr int kBlock = 8;  // px
  void build(const VdbMap& map, const Camera& camera, const Pose& T_map_camera);
  /// Range in voxels, not beyond the first occupied voxel on the ray; infinite where there is none.
  float of(int x, int y) const { return start_[static_cast<std::size_t>(y / kBlock * blocks_x_ + x / kBlock)]; }

 private:
  /// centre: of a leaf, camera frame, voxels.
  void add(const Camera& camera, const Eigen::Vector3f& centre);

  int blocks_x_ = 0, blocks_y_ = 0;
  std::vector<float> start_;  // [blocks_y * blocks_x]
};

}  // namespace ppm
