#pragma once
#include <cstdint>
#include <string>

namespace ppm {

/// What a sink says of its parameter `file`.
inline constexpr const char* kOutputNameDoc =
    "Name of the file in the run directory. \"{frame}\" becomes the frame's number in the run (six digits); without "
    "it, each writing "
    "replaces the last.";

/// The name with every "{frame}" replaced by the number, zero-padded to six digits.
std::string output_name(std::string name, std::int64_t frame);

}  // namespace ppm
