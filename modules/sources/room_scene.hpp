#pragma once
#include "modules/sources/analytic_scene.hpp"

namespace ppm {

/// Inner size of the furnished room, m: x in +-half.x, y in +-half.y, z from the floor at 0 to 2 half.z.
inline const Eigen::Vector3d kRoomHalf{2.8, 2.3, 1.3};

/// A living room with a place to eat: sofa, armchair, coffee table, bookshelf, sideboard with television, dining table
/// with chairs, window with curtains, door, plants, lamps and small things; some 340 solids. World frame: z up, floor
/// at z = 0, origin in the middle of the floor, metres. The walls are closed: a ray from inside always hits something.
/// Between 1 m and 2.5 m of height nothing stands within 1.1 m of the room's middle axis.
AnalyticScene make_room();

}  // namespace ppm
