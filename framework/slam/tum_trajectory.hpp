#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Text of a path in TUM format: "stamp tx ty tz qx qy qz qw" a line, metres, seconds; T_map_camera.
/// Source: Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
std::string to_tum(const std::vector<StampedPose>& path);
/// Reads a pose as a line of a TUM file has it behind the stamp, "tx ty tz qx qy qz qw". Returns what is wrong, or "".
std::string parse_tum_pose(const std::string& text, Pose& T_map_camera);
/// Reads a TUM file ('#' comments allowed); frame is the line's order, from 0. Throws DataError with file and line.
std::vector<StampedPose> read_tum(const std::filesystem::path& file);

}  // namespace ppm
