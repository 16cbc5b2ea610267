#pragma once
#include <string>

namespace ppm {

/// A time for people: "4:07", "1:00:00".
std::string clock_text(double seconds);

}  // namespace ppm
