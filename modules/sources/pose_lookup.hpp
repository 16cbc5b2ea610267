#pragma once
#include <optional>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// The pose of a path at a time: between the two poses around it (see interpolate) where both are at most max_dt_s
/// away, else the nearer one if that is; empty where none is. path: ascending stamps.
std::optional<Pose> pose_at(const std::vector<StampedPose>& path, double stamp_s, double max_dt_s);

}  // namespace ppm
