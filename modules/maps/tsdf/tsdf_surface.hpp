#pragma once
#include <optional>

#include "framework/core/se3.hpp"
#include "modules/maps/tsdf/tsdf_map.hpp"

namespace ppm {

/// Reads surfaces off one volume: signed distances linear between the centres of voxels, where all eight were seen. One a
/// thread.
class TsdfSurface {
 public:
  explicit TsdfSurface(const TsdfMap& map);

  struct Point {
    double range_m = 0;
    Eigen::Vector3f normal;  ///< unit, along the gradient of the distance; zero where not all around was seen
    float weight = 0;        ///< images that the nearest voxel is the mean of
  };
  /// Where a ray first passes from positive to negative distance. A surface is not entered from behind, nor from where
  /// nothing was seen. direction: unit.
  std::optional<Point> look(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double range_most_m);
  /// Signed distance in truncations; empty where nothing is known.
  std::optional<double> distance(const Eigen::Vector3d& p);

 private:
  struct Voxel {
    float distance = 0, weight = 0;
  };
  const TsdfBlock* block_at(const Eigen::Vector3i& place);
  Voxel voxel_at(const Eigen::Vector3i& voxel);
  /// distance(), or that of the nearest voxel where it is far from zero: one voxel is looked at in place of eight.
  std::optional<double> distance_or_far(const Eigen::Vector3d& p);
  Point surface_between(double before_m, double before, double after_m, double after, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& direction);
  Eigen::Vector3f normal_at(const Eigen::Vector3d& p);

  const TsdfMap& map_;
  const double voxel_m_, block_m_, truncation_m_;
  Eigen::Vector3i place_ = Eigen::Vector3i::Zero();  // of block_
  const TsdfBlock* block_;                           // the last that was asked for
};

}  // namespace ppm
