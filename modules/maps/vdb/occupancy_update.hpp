#pragma once
#include <memory>

#include "framework/core/parallel.hpp"
#include "framework/core/se3.hpp"
#include "modules/maps/vdb/depth_bounds.hpp"
#include "modules/maps/vdb/occupancy_model.hpp"
#include "modules/maps/vdb/ray_marks.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// What a frame says, for all particles alike.
struct OccupancyView {
  OccupancyForm form = OccupancyForm::profile;
  PixelProfiles profiles;
  DepthBounds bounds;        ///< of the profiles; literal: not used
  std::vector<RayEnd> ends;  ///< literal: the rays
  /// The maps that it is written into have this one's settings.
  void build(const Frame& frame, const VdbMap& map, const OccupancySettings& settings);
};

/// The map after an image seen from a pose: log-odds <- keep * log-odds + evidence, within the clamps, once a voxel.
/// profile  each voxel whose centre falls on a pixel with a measurement, and is not far behind it, by that pixel's profile
/// literal  each voxel that a ray ends in (a hit) or passes (a miss)
/// Whole leaves in free space change as one. What would not change is not touched, so that it stays shared.
/// The same bytes for any number of workers.
std::shared_ptr<const VdbMap> update_occupancy(std::shared_ptr<const VdbMap> map, const OccupancyView& view,
                                               const Pose& T_map_camera, const Workers& workers);

}  // namespace ppm
