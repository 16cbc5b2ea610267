#pragma once
#include <filesystem>

namespace ppm {

/// What a `path` parameter means. A leading "${PPM_DATA}" stands for the environment variable PPM_DATA, or for "../shared/data"
/// where that is unset or empty; a relative path counts from the current directory. No other variable is known: a '$' that is
/// left throws DataError.
std::filesystem::path expand_data_path(const std::filesystem::path& path);

}  // namespace ppm
