#include "framework/graph/param_text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ppm {

namespace {

/// Beyond this an integer's limit is "none" to a reader.
constexpr double kHuge = 9e18;

std::string with_unit(const std::string& number, const ParamSpec& spec) {
  return spec.unit().empty() ? number : number + " " + spec.unit();
}

}  // namespace

std::string type_text(const ParamSpec& spec) {
  switch (spec.type()) {
    case ParamSpec::Type::boolean:
      return "boolean";
    case ParamSpec::Type::integer:
      return "integer";
    case ParamSpec::Type::real:
      return "number";
    case ParamSpec::Type::text:
      return "text";
    case ParamSpec::Type::path:
      return "path";
    case ParamSpec::Type::choice:
      return "choice";
    case ParamSpec::Type::vector3:
      return "3 numbers";
  }
  PPM_CHECK(false, "type {}", static_cast<int>(spec.type()));
}

std::string default_text(const ParamSpec& spec) {
  if (spec.is_required()) return "(required)";
  const auto& text = spec.default_text();
  return text.empty() ? "\"\"" : with_unit(text, spec);
}

std::string allowed_text(const ParamSpec& spec) {
  if (!spec.choices().empty()) return fmt::format("one of {}", fmt::join(spec.choices(), ", "));
  const bool least = std::isfinite(spec.least());
  const bool most = std::isfinite(spec.most()) && spec.most() < kHuge;
  if (least && most && !spec.least_excluded()) {
    return with_unit(fmt::format("{} .. {}", spec.least(), spec.most()), spec);
  }
  std::string text;
  if (least) text = with_unit(fmt::format("{} {}", spec.least_excluded() ? ">" : ">=", spec.least()), spec);
  if (most) text += (text.empty() ? "" : ", ") + with_unit(fmt::format("<= {}", spec.most()), spec);
  return text;
}

}  // namespace ppm
