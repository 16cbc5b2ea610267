#include <CLI/CLI.hpp>

#include "apps/calibrate_camera.hpp"
#include "apps/calibrate_motion.hpp"
#include "apps/calibrate_noise.hpp"
#include "apps/calibrate_sensor.hpp"
#include "apps/commands.hpp"

namespace ppm {

void add_calibrate(CLI::App& app) {
  auto* command = app.add_subcommand("calibrate", "Fits the parameters of a module to data");
  command->require_subcommand(1);
  add_calibrate_camera(*command);
  add_calibrate_noise(*command);
  add_calibrate_sensor(*command);
  add_calibrate_motion(*command);
}

}  // namespace ppm
