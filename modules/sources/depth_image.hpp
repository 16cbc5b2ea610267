#pragma once
#include <filesystem>

#include "framework/slam/frame.hpp"

namespace ppm {

/// Sets the camera's cols and rows to the size of a depth image, the first of a sequence. Throws DataError.
void set_image_size(const std::filesystem::path& file, std::int64_t index, Camera& camera);

/// Reads a 16-bit gray PNG into frame.depth: value / units_per_m is the depth in m; 0 (no return) and 65535 (saturated)
/// become NaN. Takes frame.index for messages and the size that the image must have from frame.camera. Throws
/// DataError.
void read_depth_image(const std::filesystem::path& file, double units_per_m, Frame& frame);

/// Reads a colour image of the depth image's size into frame.color. Throws DataError, also where the sizes differ.
void read_color_image(const std::filesystem::path& file, Frame& frame);

}  // namespace ppm
