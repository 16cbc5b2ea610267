#pragma once
#include <vector>

#include "modules/sources/camera_path.hpp"

namespace ppm {

/// Ways through the house of the simulation (docs/simulation.md shows them): a furnished flat of 19 x 11.4 m without ceiling,
/// z up, floor at 0, origin in the middle.
enum class HousePlan {
  loop,       ///< from the living room round the bedroom's screen and back; the first metres once more
  tour,       ///< the loop, then on through kitchen, dining place and winter garden, back to the beginning
  corridor,   ///< between two good views a stretch along a bare wall that fills the view, slower in the middle
  fast_turn,  ///< a turn that leaves little overlap between images, and a slow one back to what was seen before it
  kidnap,     ///< out of the living room into the bedroom, then all at once near the beginning again
};

/// Waypoints of a plan. The camera is carried at the height of the eyes, 1.4 m, and stays 0.4 m clear of everything.
std::vector<Waypoint> house_plan(HousePlan plan);

}  // namespace ppm
