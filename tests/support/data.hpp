#pragma once
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace ppm::test {

/// The folder of an optional data set ($PPM_DATA, or ../shared/data beside the project); empty where it is absent, and then the
/// test that asks says so, visibly.
inline std::optional<std::filesystem::path> data_path(const std::string& name) {
  const char* root = std::getenv("PPM_DATA");
  auto path = (root ? std::filesystem::path(root) : std::filesystem::path(PPM_SOURCE_DIR) / "../shared/data") / name;
  if (std::filesystem::exists(path)) return path;
  std::cout << "SKIPPED: no data at " << path << " (set PPM_DATA)\n";
  return std::nullopt;
}

}  // namespace ppm::test
