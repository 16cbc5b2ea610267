#pragma once
#include "framework/core/se3.hpp"

namespace ppm {

/// Images per second of the room's camera.
inline constexpr double kRoomRateHz = 15;

/// T_world_camera, t_s >= 0 seconds after the start, of a hand-held camera that starts at rest, walks round the middle
/// of the room (make_room) at the height of the eyes and looks across it: one loop of 360 degrees in about 24 s, then
/// the next. A sum of sines, smooth in all derivatives. Between images it moves less than 2 cm and turns less than 1.5
/// degrees.
Pose room_camera_pose(double t_s);

}  // namespace ppm
