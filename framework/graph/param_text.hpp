#pragma once
#include <string>

#include "framework/config/params.hpp"

namespace ppm {

/// A parameter's type in words: "boolean", "integer", "number, m", "text", "path", "choice", "3 numbers".
std::string type_text(const ParamSpec& spec);
/// Its default with the unit, angles in degrees: "0.02 m"; "(required)" where it has none.
std::string default_text(const ParamSpec& spec);
/// What is allowed: ">= 0 m", "0 .. 1", "one of a, b"; "" where everything of its type is.
std::string allowed_text(const ParamSpec& spec);

}  // namespace ppm
