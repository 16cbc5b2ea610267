#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Text of a path in TUM format: "stamp tx ty tz qx qy qz qw" a line, metres, seconds; T_map_camera.
/// Source: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
std::string to_tum(const std::vector<StampedPose>& path);
/// Reads a TUM file ('#' comments allowed); frame is the line's order, from 0. Throws DataError with file and line.
std::vector<StampedPose> read_tum(const std::filesystem::path& file);

}  // namespace ppm
