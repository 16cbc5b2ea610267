#include "apps/module_skeleton.hpp"

#include <cctype>
#include <map>
#include <regex>

#include "apps/module_templates.hpp"

namespace ppm {

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// "constant_velocity" becomes "ConstantVelocity".
std::string class_name(const std::string& name) {
  std::string out;
  bool up = true;
  for (char c : name) {
    if (c != '_') out += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    up = c == '_';
  }
  return out;
}

}  // namespace

std::string refuse_module_name(const std::string& name) {
  static const std::regex pattern("[a-z][a-z0-9_]*\\.[a-z][a-z0-9_]*");
  return std::regex_match(name, pattern)
             ? ""
             : "a module is called category.name, of small letters, digits and _, for example motion.mine";
}

std::string module_skeleton(const std::string& name) {
  static const std::map<std::string, const char*> by_category{
      {"source", kSourceTemplate},         {"sensor", kSensorTemplate},
      {"preprocess", kPreprocessTemplate}, {"motion", kMotionTemplate},
      {"prediction", kPredictionTemplate}, {"weighting", kWeightingTemplate},
      {"map_update", kMapUpdateTemplate},  {"sink", kSinkTemplate}};
  const auto dot = name.find('.');
  const auto found = by_category.find(name.substr(0, dot));
  const std::string text = found == by_category.end() ? kBeliefTemplate : found->second;
  return replaced(replaced(text, "NewModule", class_name(name.substr(dot + 1))), "category.name", name);
}

std::string module_folder(const std::string& category) {
  if (category == "source" || category == "sink") return category + "s";
  return category == "map" ? "map_init" : category;
}

}  // namespace ppm
