#include "framework/core/data_path.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr std::string_view kVariable = "${PPM_DATA}";
constexpr const char* kDefaultRoot = "../shared/data";

}  // namespace

std::filesystem::path expand_data_path(const std::filesystem::path& path) {
  std::string rest = path.string();
  std::string root;
  if (rest.starts_with(kVariable)) {
    const char* value = std::getenv("PPM_DATA");
    root = value && *value ? value : kDefaultRoot;
    rest.erase(0, kVariable.size());
  }
  if (rest.find('$') != std::string::npos)
    throw DataError(path.string(), "only ${PPM_DATA}, at the beginning, is replaced in a path");
  return root + rest;
}

}  // namespace ppm
