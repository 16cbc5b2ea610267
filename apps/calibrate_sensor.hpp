#pragma once

namespace CLI {
class App;
}

namespace ppm {

/// `ppm calibrate sensor GRAPH`: the noise of a time-of-flight camera, from images of a still camera.
void add_calibrate_sensor(CLI::App& calibrate);

}  // namespace ppm
