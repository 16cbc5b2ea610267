#include "framework/graph/param_text.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ppm {

namespace {

/// The unit that a reader thinks in, and its size in SI: angles in degrees.
std::pair<std::string, double> readable_unit(const ParamSpec& spec) {
  constexpr double kDegree = std::numbers::pi / 180;
  if (spec.unit().starts_with("rad")) return {"deg" + spec.unit().substr(3), kDegree};
  return {spec.unit(), 1};
}

std::string number(double value, const ParamSpec& spec) {
  const double size = readable_unit(spec).second;
  return size == 1 ? fmt::format("{}", value) : fmt::format("{:.6g}", value / size);
}

std::string with_unit(const std::string& text, const ParamSpec& spec) {
  const auto unit = readable_unit(spec).first;
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace

std::string type_text(const ParamSpec& spec) {
  switch (spec.type()) {
    case ParamSpec::Type::boolean:
      return "boolean";
    case ParamSpec::Type::integer:
      return "integer";
    case ParamSpec::Type::real:
      return spec.unit().empty() ? "number" : fmt::format("number, {}", spec.unit());
    case ParamSpec::Type::text:
      return "text";
    case ParamSpec::Type::path:
      return "path";
    case ParamSpec::Type::choice:
      return "choice";
    case ParamSpec::Type::vector3:
      return spec.unit().empty() ? "3 numbers" : fmt::format("3 numbers, {}", spec.unit());
  }
  PPM_CHECK(false, "type {}", static_cast<int>(spec.type()));
}

std::string default_text(const ParamSpec& spec) {
  if (spec.is_required()) return "(required)";
  const auto& text = spec.default_text();
  if (text.empty()) return "\"\"";
  if (spec.type() == ParamSpec::Type::real) return with_unit(number(std::stod(text), spec), spec);
  return spec.unit().empty() ? text : text + " " + spec.unit();
}

std::string allowed_text(const ParamSpec& spec) {
  if (!spec.choices().empty()) return fmt::format("one of {}", fmt::join(spec.choices(), ", "));
  const bool least = std::isfinite(spec.least());
  const bool most = std::isfinite(spec.most());
  if (least && most && !spec.least_excluded()) {
    return with_unit(number(spec.least(), spec) + " .. " + number(spec.most(), spec), spec);
  }
  std::string text;
  if (least) text = with_unit((spec.least_excluded() ? "> " : ">= ") + number(spec.least(), spec), spec);
  if (most) text += (text.empty() ? "" : ", ") + with_unit("<= " + number(spec.most(), spec), spec);
  return text;
}

}  // namespace ppm
