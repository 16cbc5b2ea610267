#include "apps/compare/clock_text.hpp"

#include <cmath>
#include <fmt/core.h>

namespace ppm {

std::string clock_text(double seconds) {
  const auto s = std::llround(seconds);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace ppm
