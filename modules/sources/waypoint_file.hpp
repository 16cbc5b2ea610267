#pragma once
#include <filesystem>
#include <vector>

#include "modules/sources/camera_path.hpp"

namespace ppm {

/// Reads waypoints, one a line: "x y z yaw pitch [seconds]", metres, degrees and seconds since the waypoint before; the line
/// "jump" says that the camera is at the next waypoint all at once. '#' begins a comment.
/// throws  DataError naming file and line: a malformed line, seconds that are not positive, fewer than two waypoints at the
///         beginning, at the end or between two jumps
std::vector<Waypoint> read_waypoints(const std::filesystem::path& file);

}  // namespace ppm
