#pragma once
#include <filesystem>

namespace ppm {

/// The folder that a `path` parameter means. A leading "${PPM_DATA}" stands for the environment variable PPM_DATA, or
/// for
/// "../shared/data" where that is unset or empty; a relative path counts from the current directory. No other variable
/// is known: a '$' that is left throws DataError.
std::filesystem::path expand_data_path(const std::filesystem::path& path);

/// expand_data_path, and throws DataError where that is no folder.
std::filesystem::path data_folder(const std::filesystem::path& path);

}  // namespace ppm
