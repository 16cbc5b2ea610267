#pragma once
#include <string>
#include <utility>
#include <vector>

namespace ppm {

/// What the colours of a mesh say.
enum class Show {
  shaded,  ///< nothing: a lit surface; pictures tint it by height
  sigma,   ///< standard deviation of the surface along its normal
  mean,    ///< how far the surface lies from its faces
  normal,  ///< direction of the normal: red, green, blue = x, y, z
  color    ///< the map's own colour
};
/// The names in graphs and on the command line.
const std::vector<std::pair<std::string, Show>>& show_names();
std::string to_string(Show show);

}  // namespace ppm
