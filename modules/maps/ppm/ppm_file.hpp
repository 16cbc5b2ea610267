#pragma once
#include <filesystem>
#include <memory>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// Writes a map as "map.ppm": magic, version, settings, then chunk by chunk with a checksum (XXH3) each, little endian;
/// atomic.
void save_ppm(const PpmMap& map, const std::filesystem::path& file);
/// Reads it back, exactly. Throws DataError with the reason where the file is cut short, altered, or of another
/// version.
std::shared_ptr<const PpmMap> load_ppm(const std::filesystem::path& file);

}  // namespace ppm
