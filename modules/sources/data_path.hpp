#pragma once
#include <filesystem>

#include "framework/core/data_path.hpp"

namespace ppm {

/// expand_data_path, and throws DataError where that is no folder.
std::filesystem::path data_folder(const std::filesystem::path& path);

}  // namespace ppm
