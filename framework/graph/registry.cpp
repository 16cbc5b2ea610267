#include "framework/graph/registry.hpp"

#include <regex>

namespace ppm {

void Registry::add(ModuleInfo info) {
  static const std::regex pattern("[a-z][a-z0-9_]*\\.[a-z][a-z0-9_]*");
  PPM_CHECK(std::regex_match(info.name, pattern), "module name '{}' is not of the form category.name", info.name);
  auto name = info.name;
  auto [it, added] = modules_.emplace(std::move(name), std::move(info));
  PPM_CHECK(added, "module '{}' is registered already ({})", it->first, it->second.origin);
}

void Registry::add_map_kind(const std::string& kind, std::shared_ptr<const MapCodec> codec) {
  PPM_CHECK(map_kinds_.emplace(kind, std::move(codec)).second, "maps of kind '{}' have a codec already", kind);
}

const ModuleInfo* Registry::find(const std::string& name) const {
  auto it = modules_.find(name);
  return it == modules_.end() ? nullptr : &it->second;
}

std::vector<const ModuleInfo*> Registry::all() const {
  std::vector<const ModuleInfo*> infos;
  for (const auto& [name, info] : modules_) infos.push_back(&info);
  return infos;
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, info] : modules_) names.push_back(name);
  return names;
}

}  // namespace ppm
