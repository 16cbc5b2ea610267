#pragma once

namespace CLI {
class App;
}

namespace ppm {

/// `ppm calibrate noise RUN`: the noise parameters of a source, from the held-out frames of a run beside its map.
void add_calibrate_noise(CLI::App& calibrate);

}  // namespace ppm
