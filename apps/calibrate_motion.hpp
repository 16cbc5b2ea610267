#pragma once

namespace CLI {
class App;
}

namespace ppm {

/// `ppm calibrate motion GRAPH`: the noise of motion models, from a source with reference poses.
void add_calibrate_motion(CLI::App& calibrate);

}  // namespace ppm
