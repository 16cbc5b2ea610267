#include "framework/config/units.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// In SI: number * times / by. Two factors, so that "7 cm" is the double nearest to 0.07 (a factor 0.01 is not exact).
struct Unit {
  std::string_view name, si;
  double times, by;
};

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.80665;  // m/s^2, standard

// The SI unit first within its kind.
// clang-format off
constexpr Unit kUnits[] = {
    {"", "", 1, 1}, {"%", "", 1, 100},
    {"m", "m", 1, 1}, {"km", "m", 1000, 1}, {"cm", "m", 1, 100}, {"mm", "m", 1, 1000}, {"um", "m", 1, 1e6},
    {"µm", "m", 1, 1e6},
    {"rad", "rad", 1, 1}, {"mrad", "rad", 1, 1000}, {"deg", "rad", kPi, 180}, {"°", "rad", kPi, 180},
    {"s", "s", 1, 1}, {"ms", "s", 1, 1000}, {"us", "s", 1, 1e6}, {"µs", "s", 1, 1e6}, {"min", "s", 60, 1},
    {"h", "s", 3600, 1},
    {"Hz", "Hz", 1, 1}, {"kHz", "Hz", 1000, 1}, {"1/s", "Hz", 1, 1},
    {"m/s", "m/s", 1, 1}, {"cm/s", "m/s", 1, 100}, {"mm/s", "m/s", 1, 1000}, {"km/h", "m/s", 1, 3.6},
    {"rad/s", "rad/s", 1, 1}, {"mrad/s", "rad/s", 1, 1000}, {"deg/s", "rad/s", kPi, 180}, {"°/s", "rad/s", kPi, 180},
    {"m/s^2", "m/s^2", 1, 1}, {"m/s²", "m/s^2", 1, 1}, {"cm/s^2", "m/s^2", 1, 100}, {"mm/s^2", "m/s^2", 1, 1000},
    {"g", "m/s^2", kGravity, 1},
    {"rad/s^2", "rad/s^2", 1, 1}, {"deg/s^2", "rad/s^2", kPi, 180},
    {"1/m", "1/m", 1, 1}, {"1/cm", "1/m", 100, 1}, {"1/mm", "1/m", 1000, 1},
    {"m^2", "m^2", 1, 1}, {"m²", "m^2", 1, 1}, {"cm^2", "m^2", 1, 1e4}, {"mm^2", "m^2", 1, 1e6},
    {"px", "px", 1, 1},
    {"bytes", "bytes", 1, 1}, {"B", "bytes", 1, 1}, {"kB", "bytes", 1e3, 1}, {"MB", "bytes", 1e6, 1},
    {"GB", "bytes", 1e9, 1}, {"KiB", "bytes", 1024, 1}, {"MiB", "bytes", 1024. * 1024, 1},
    {"GiB", "bytes", 1024. * 1024 * 1024, 1},
};
// clang-format on

struct Kind {
  std::string_view si, words;
};
constexpr Kind kKinds[] = {{"", "a pure number"},
                           {"m", "a length"},
                           {"rad", "an angle"},
                           {"s", "a time"},
                           {"Hz", "a frequency"},
                           {"m/s", "a speed"},
                           {"rad/s", "an angular speed"},
                           {"m/s^2", "an acceleration"},
                           {"rad/s^2", "an angular acceleration"},
                           {"1/m", "an inverse length"},
                           {"m^2", "an area"},
                           {"px", "a number of pixels"},
                           {"bytes", "an amount of memory"}};

std::string_view words_for(std::string_view si) {
  for (const auto& k : kKinds)
    if (k.si == si) return k.words;
  PPM_CHECK(false, "'{}' is no SI unit of a parameter", si);
  return {};
}

const Unit* find_unit(std::string_view name) {
  for (const auto& u : kUnits)
    if (u.name == name) return &u;
  return nullptr;
}

std::string wanted(std::string_view si) {
  std::string list;
  for (const auto& name : units_of(si))
    if (!name.empty()) list += (list.empty() ? "" : ", ") + name;
  return fmt::format("{} is wanted{}", words_for(si), list.empty() ? "" : " (" + list + ")");
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Splits off the number in front. Returns what is wrong, or "".
std::string take_number(std::string_view text, std::string_view& rest, double& number) {
  std::string_view digits = text;
  const bool plus = !digits.empty() && digits.front() == '+';
  if (plus) digits.remove_prefix(1);
  const bool minus = !plus && !digits.empty() && digits.front() == '-';
  const std::string_view magnitude = digits.substr(minus ? 1 : 0);
  const bool starts_well =
      !magnitude.empty() &&
      (is_digit(magnitude[0]) || (magnitude.size() > 1 && magnitude[0] == '.' && is_digit(magnitude[1])));
  if (!starts_well) return fmt::format("'{}' is not a number", text);
  if (magnitude.size() > 1 && magnitude[0] == '0' && is_digit(magnitude[1]))
    return fmt::format("'{}' has a leading zero, which YAML 1.1 reads as octal: write it without", text);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range || !std::isfinite(number))
    return fmt::format("'{}' is too large or too small for a number", text);
  if (error != std::errc{}) return fmt::format("'{}' is not a number", text);
  rest = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return "";
}

}  // namespace

std::string parse_quantity(std::string_view text, std::string_view si_unit, double& value) {
  text = trimmed(text);
  std::string_view rest;
  double number = 0;
  if (auto wrong = take_number(text, rest, number); !wrong.empty()) return wrong + "; " + wanted(si_unit);
  const std::string_view name = trimmed(rest);
  if (name.empty()) {
    value = number;
    return "";
  }
  const Unit* unit = find_unit(name);
  if (!unit) return fmt::format("'{}' has the unknown unit '{}'; {}", text, name, wanted(si_unit));
  if (unit->si != si_unit)
    return fmt::format("'{}' is {}; {}", text, unit->name == "%" ? "a percentage" : words_for(unit->si),
                       wanted(si_unit));
  const double si = number * unit->times / unit->by;
  if (!std::isfinite(si)) return fmt::format("'{}' is too large", text);
  value = si;
  return "";
}

bool is_si_unit(std::string_view unit) {
  for (const auto& k : kKinds)
    if (k.si == unit) return true;
  return false;
}

std::vector<std::string> units_of(std::string_view si_unit) {
  std::vector<std::string> names;
  for (const auto& u : kUnits)
    if (u.si == si_unit) names.emplace_back(u.name);
  return names;
}

}  // namespace ppm
