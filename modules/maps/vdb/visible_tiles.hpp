#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/se3.hpp"
#include "modules/maps/vdb/depth_bounds.hpp"

namespace ppm {

/// What a view says about a tile, leaf by leaf (bit n: leaf n).
struct SeenTile {
  Cell cell;
  std::uint8_t free = 0;      ///< leaves whose voxels all get the whole `miss`
  std::uint8_t mixed = 0;     ///< leaves to be looked at voxel by voxel ...
  std::uint8_t no_hits = 0;   ///< ... of these, those whose voxels get the whole `miss` or nothing
};
static_assert(kVdbTileLeaves <= 8, "a bit a leaf");

/// A tile of which every leaf is free.
constexpr std::uint8_t kAllLeaves = 0xff;

/// The tiles of which a view says anything, in a fixed order. Space is halved from large cubes down to leaves as far as
/// the image is not alike in a cube.
std::vector<SeenTile> seen_tiles(const PixelProfiles& profiles, const DepthBounds& bounds, const Pose& T_map_camera,
                                 double voxel_size_m);

}  // namespace ppm
