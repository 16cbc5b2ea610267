#include "modules/sources/data_path.hpp"

#include <string>
#include <system_error>

#include "framework/core/error.hpp"

namespace ppm {

std::filesystem::path data_folder(const std::filesystem::path& path) {
  std::filesystem::path folder = expand_data_path(path);
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return folder;
  const char* hint = folder == path ? "" : " (the environment variable PPM_DATA says where data is)";
  throw DataError(
      folder.string(),
      std::string(std::filesystem::exists(folder, error) ? "is no folder" : "there is no such folder") + hint);
}

}  // namespace ppm
