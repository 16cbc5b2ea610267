#pragma once
#include <cstdint>

namespace ppm {

/// How evidence is added to a voxel: keep * code + evidence within the clamps, rounded to even; the unknown counts as 0.
struct LeafSum {
  float keep;         ///< share of a voxel's log-odds that stays
  float least, most;  ///< clamps, codes
};

/// An image as seen by the voxels of a leaf.
struct LeafLook {
  float origin[3];              ///< centre of the leaf's lowest voxel, camera frame, m
  float step[3][3];             ///< [axis] from a voxel to the next along the map's x, y, z, camera frame, m
  float fx, fy, cx, cy;         ///< px; cx, cy with the half pixel that rounds to the nearest
  std::int32_t cols, rows;
  const float* pixel;           ///< [rows*cols*4], see PixelProfiles::Pixel
  float hit, miss;              ///< see PixelProfiles
};

/// Adds the same evidence, in codes, to each voxel of a leaf.
void add_to_leaf(const LeafSum& sum, float evidence, std::int16_t* codes);

/// Adds to each voxel of a leaf (512, in the order of vdb_voxel) what the pixel that its centre falls on says of it:
/// nothing where that is no pixel, or the voxel lies beyond its end. The same bytes on every processor.
void look_at_leaf(const LeafLook& look, const LeafSum& sum, std::int16_t* codes);

}  // namespace ppm
