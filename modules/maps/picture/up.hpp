#pragma once
#include <string>
#include <utility>
#include <vector>

#include "modules/maps/picture/overview.hpp"

namespace ppm {

/// Which way is up in the map frame.
enum class Up { automatic, x, minus_x, y, minus_y, z, minus_z };
/// The names in graphs and on the command line: "auto", "x", "-x" ...
const std::vector<std::pair<std::string, Up>>& up_names();
/// Unit, map frame. Automatic: estimate_up().
Eigen::Vector3d up_direction(Up up, const Mesh& mesh, const std::vector<Pose>& path);

}  // namespace ppm
