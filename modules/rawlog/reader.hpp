#pragma once
#include "modules/rawlog/rawlog.hpp"

namespace ppm {

/// RawlogLibrary::open.
std::unique_ptr<const Rawlog> open_rawlog(const std::filesystem::path& file);

}  // namespace ppm
