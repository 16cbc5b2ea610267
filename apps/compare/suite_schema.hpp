#pragma once
#include <string>

namespace ppm {

/// JSON Schema of suite files, for editors.
std::string suite_schema();

}  // namespace ppm
