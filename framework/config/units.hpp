#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ppm {

/// A number with its unit as written: "2 cm", "1 deg", "0.5", "10 Hz", "3e-4 m/s^2". Decimal and finite: infinities,
/// NaN, hexadecimal and leading zeros (`010` is 8 to YAML 1.1) are refused. Converts to the SI unit that a parameter
/// declares. A bare number is taken to be in that unit already. Returns an empty string and sets `value`, or says what
/// is wrong: "'2 deg' is an angle; a length is wanted (m, km, cm, ...)". si_unit: one that is_si_unit() knows; "" is a
/// pure number, which may also be a percentage ("90 %").
std::string parse_quantity(std::string_view text, std::string_view si_unit, double& value);

/// True for the units that parameters can declare: "", "m", "rad", "s", "Hz", "m/s", "rad/s", "m/s^2", "rad/s^2",
/// "1/m", "m^2", "px", "bytes".
bool is_si_unit(std::string_view unit);

/// All units accepted for an SI unit, the SI unit first.
std::vector<std::string> units_of(std::string_view si_unit);

}  // namespace ppm
