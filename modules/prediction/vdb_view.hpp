#pragma once
#include <cstdint>
#include <span>

#include "framework/slam/prediction.hpp"
#include "modules/maps/vdb/vdb_map.hpp"
#include "modules/prediction/ray_starts.hpp"
#include "modules/prediction/voxel_ray.hpp"

namespace ppm {

/// A view of an occupancy grid that follows rays when it is asked: of the compared pixels alone where a likelihood asks,
/// of all where an alignment does.
class VdbView final : public DeferredView {
 public:
  /// map: outlives the view. view: has camera and pose.
  void start(const VdbMap& map, const VoxelRayOptions& options, const Prediction& view);

  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;
  void elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                std::span<std::uint32_t> face) const override;

 private:
  const VdbMap* map_ = nullptr;
  VoxelRayOptions options_;
  Eigen::Array3f low_, high_;  ///< voxels: the box of all tiles
  RayStarts starts_;
};

}  // namespace ppm
