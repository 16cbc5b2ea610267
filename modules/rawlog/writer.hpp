#pragma once
#include "modules/rawlog/rawlog.hpp"

namespace ppm {

/// RawlogLibrary::frame_bytes.
std::string rawlog_bytes(const Frame& frame, const RawlogFormat& format);

}  // namespace ppm
