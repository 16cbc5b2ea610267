#pragma once
#include <cstddef>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/slam/surface_patches.hpp"

namespace ppm {

/// A frame as a camera is fitted to it.
struct CalibrationFrame {
  SurfacePatches patches;
  Pose T_world_camera = Pose::Identity();
};

/// Two frames, first < second, that see the same surface.
struct FramePair {
  std::size_t first = 0, second = 0;
  double overlap = 0;   ///< share of the first's patches that lie on the second's, or the other way round: the smaller
  double tilt_rad = 0;  ///< angle between their optical axes
};

/// All pairs with at least that overlap. A patch lies on another where the nearest in the image is within `distance_m` of
/// it and its normal within 45 degrees.
std::vector<FramePair> overlapping_pairs(const std::vector<CalibrationFrame>& frames, const CameraCorrection& correction,
                                         double least_overlap, double distance_m, const Workers& workers);

}  // namespace ppm
