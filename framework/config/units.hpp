#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ppm {

/// A number with its unit as written: "2 cm", "1 deg", "0.5", "10 Hz", "3e-4 m/s^2", ".inf" is refused.
/// Converts to the SI unit that a parameter declares. A bare number is taken to be in that unit already.
/// Returns an empty string and sets `value`, or says what is wrong: "'2 deg' is an angle; 'sigma_t' is a length (m, cm, mm, ...)".
/// si_unit: "" (a pure number; also accepts "%"), "m", "rad", "s", "Hz", "m/s", "rad/s", "m/s^2", "px", "m^2", "bytes".
std::string parse_quantity(std::string_view text, std::string_view si_unit, double& value);

/// All units accepted for an SI unit, the SI unit first.
std::vector<std::string> units_of(std::string_view si_unit);

}  // namespace ppm
