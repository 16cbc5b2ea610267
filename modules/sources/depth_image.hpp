#pragma once
#include <filesystem>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Reads a 16-bit gray PNG into frame.depth and sets the camera's cols and rows. Value / units_per_m is the depth in m;
/// 0 (no return) and 65535 (saturated) become NaN. Uses frame.index for messages. Throws DataError.
void read_depth_image(const std::filesystem::path& file, double units_per_m, Frame& frame);

/// Reads a colour image of the depth image's size into frame.color. Throws DataError, also where the sizes differ.
void read_color_image(const std::filesystem::path& file, Frame& frame);

}  // namespace ppm
