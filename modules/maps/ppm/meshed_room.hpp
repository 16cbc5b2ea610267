#pragma once
#include "framework/core/se3.hpp"
#include "modules/maps/ppm/triangle_mesh.hpp"

namespace ppm {

/// A closed room of 6 x 5 x 2.7 m with ten boxes on its floor, its walls waved by 2 cm, uniformly meshed with about
/// `faces` triangles: the scene of benchmarks and of comparisons between back-ends. z is up, the origin a corner of the
/// floor.
TriangleMesh meshed_room(int faces);

/// A camera in that room, on a circle of 1 m round its middle, 1.5 m high, that looks outwards and a little down.
/// angle: rad.
Pose room_view(double angle);

}  // namespace ppm
