#include <catch2/catch.hpp>
#include <numbers>

#include "framework/config/units.hpp"

using Catch::Matchers::Contains;
using ppm::parse_quantity;

namespace {

constexpr double kPi = std::numbers::pi;

/// The value read, or NaN with a failed check where there is a complaint.
double read(const std::string& text, const std::string& unit) {
  double value = std::numeric_limits<double>::quiet_NaN();
  CHECK(parse_quantity(text, unit, value) == "");
  return value;
}

std::string complaint(const std::string& text, const std::string& unit) {
  double value = 42;
  auto wrong = parse_quantity(text, unit, value);
  CHECK(value == 42);
  return wrong;
}

}  // namespace

TEST_CASE("quantities become SI") {
  CHECK(read("2 cm", "m") == 0.02);
  CHECK(read("2cm", "m") == 0.02);
  CHECK(read("  2   cm ", "m") == 0.02);
  CHECK(read("1.5 km", "m") == 1500);
  CHECK(read("250 um", "m") == 250e-6);
  CHECK(read("250 µm", "m") == 250e-6);
  CHECK(read("180 deg", "rad") == kPi);
  CHECK(read("90°", "rad") == kPi / 2);
  CHECK(read("5 ms", "s") == 0.005);
  CHECK(read("2 min", "s") == 120);
  CHECK(read("10 Hz", "Hz") == 10);
  CHECK(read("10 1/s", "Hz") == 10);
  CHECK(read("3 m/s", "m/s") == 3);
  CHECK(read("36 km/h", "m/s") == 10);
  CHECK(read("1 deg/s", "rad/s") == kPi / 180);
  CHECK(read("3e-4 m/s^2", "m/s^2") == 3e-4);
  CHECK(read("1 g", "m/s^2") == 9.80665);
  CHECK(read("2 cm^2", "m^2") == 2e-4);
  CHECK(read("4 px", "px") == 4);
  CHECK(read("64 MiB", "bytes") == 64.0 * 1024 * 1024);
  CHECK(read("90 %", "") == 0.9);
  CHECK(read("0.0019 1/m", "1/m") == 0.0019);
}

TEST_CASE("a bare number is in the SI unit") {
  CHECK(read("0.25", "m") == 0.25);
  CHECK(read("+.5", "m") == 0.5);
  CHECK(read("-3.", "m") == -3);
  CHECK(read("1e-3", "") == 0.001);
  CHECK(read("0", "rad") == 0);
  CHECK(read("-0.5", "") == -0.5);
}

TEST_CASE("decimal units give the double nearest to the decimal number") {
  for (int i = 1; i < 2000; ++i) {
    double expected = 0;
    CHECK(parse_quantity(std::to_string(i) + "e-2", "m", expected) == "");
    CHECK(read(std::to_string(i) + " cm", "m") == expected);
  }
}

TEST_CASE("a wrong unit is named for what it is, and what is wanted is listed") {
  CHECK(complaint("2 deg", "m") == "'2 deg' is an angle; a length is wanted (m, km, cm, mm, um, µm)");
  CHECK(complaint("2 m", "rad") == "'2 m' is a length; an angle is wanted (rad, mrad, deg, °)");
  CHECK(complaint("2 cm", "") == "'2 cm' is a length; a pure number is wanted (%)");
  CHECK(complaint("90 %", "m") == "'90 %' is a percentage; a length is wanted (m, km, cm, mm, um, µm)");
  CHECK_THAT(complaint("1 m/s", "m/s^2"), Contains("is a speed; an acceleration is wanted"));
  CHECK_THAT(complaint("2 inch", "m"), Contains("unknown unit 'inch'"));
  CHECK_THAT(complaint("2 CM", "m"), Contains("unknown unit 'CM'"));
  CHECK_THAT(complaint("1 2", "m"), Contains("unknown unit '2'"));
  CHECK_THAT(complaint("1,5", "m"), Contains("unknown unit ',5'"));
  CHECK_THAT(complaint("1_000", ""), Contains("unknown unit '_000'"));
}

TEST_CASE("what is no number is refused") {
  for (const char* text : {"",      " ",    "cm",  "-",   "+",    ".",        "-.",   "+-1", "--1", ".inf",
                           "-.inf", ".nan", "inf", "nan", "-inf", "infinity", "true", "~",   "e3",  "1..2x"}) {
    CAPTURE(text);
    CHECK_FALSE(complaint(text, "m").empty());
  }
  CHECK_THAT(complaint(".inf", "m"), Contains("'.inf' is not a number"));
  CHECK_THAT(complaint("nan", ""), Contains("'nan' is not a number"));
  CHECK_THAT(complaint("1e999", ""), Contains("too large"));
  CHECK_THAT(complaint("1e308 km", "m"), Contains("too large"));
  CHECK_THAT(complaint("0x10", "m"), Contains("unknown unit 'x10'"));
}

TEST_CASE("leading zeros are refused, with the reason") {
  CHECK_THAT(complaint("010", ""), Contains("leading zero") && Contains("octal"));
  CHECK_THAT(complaint("-00.5 m", "m"), Contains("leading zero"));
  CHECK(read("0.5", "") == 0.5);
}

TEST_CASE("units that parameters can declare") {
  for (const char* unit :
       {"", "m", "rad", "s", "Hz", "m/s", "rad/s", "m/s^2", "rad/s^2", "1/m", "m^2", "px", "bytes"}) {
    CHECK(ppm::is_si_unit(unit));
    CHECK(ppm::units_of(unit).front() == unit);
    for (const auto& name : ppm::units_of(unit)) {
      double value = 0;
      CHECK(parse_quantity("1 " + name, unit, value) == "");
      CHECK(value > 0);
    }
  }
  CHECK_FALSE(ppm::is_si_unit("cm"));
  CHECK_FALSE(ppm::is_si_unit("furlong"));
  CHECK(ppm::units_of("furlong").empty());
}
