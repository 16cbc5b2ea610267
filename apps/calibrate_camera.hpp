#pragma once

namespace CLI {
class App;
}

namespace ppm {

/// `ppm calibrate camera GRAPH`: focal length, principal point and bend of depth, from frames that see the same surfaces.
void add_calibrate_camera(CLI::App& calibrate);

}  // namespace ppm
