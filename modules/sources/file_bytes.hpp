#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ppm {

/// All bytes of a file. Throws DataError with the system's reason; frame: the source's own number, where the file is of
/// one.
std::string read_bytes(const std::filesystem::path& file, std::optional<std::int64_t> frame = std::nullopt);

/// Throws DataError for a file that may or may not belong to one frame.
[[noreturn]] void throw_data_error(const std::filesystem::path& file, std::optional<std::int64_t> frame,
                                   const std::string& reason);

}  // namespace ppm
