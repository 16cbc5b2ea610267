#pragma once
#include <string>

namespace ppm {

/// What is wrong with the name of a module, or "": category.name, of small letters, digits and _, each part begun by a
/// letter.
std::string refuse_module_name(const std::string& name);

/// Source of a new module that compiles and does something small: what suits its category, or else a module that reads
/// and changes the belief.
std::string module_skeleton(const std::string& name);

/// The folder under modules/ for a category: "motion" is "motion", "sink" is "sinks".
std::string module_folder(const std::string& category);

}  // namespace ppm
