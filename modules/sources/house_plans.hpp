#pragma once
#include <vector>

#include "modules/sources/camera_path.hpp"

namespace ppm {

/// Ways through the house of the simulation (docs/simulation.md shows them): a furnished flat of 19 x 11.4 m without ceiling,
/// z up, floor at 0, origin in the middle.
enum class HousePlan {
  loop,  ///< from the living room round the bedroom's screen and back, the first metres once more
};

/// Waypoints of a plan. The camera is carried at the height of the eyes.
std::vector<Waypoint> house_plan(HousePlan plan);

}  // namespace ppm
