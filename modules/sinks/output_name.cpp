#include "modules/sinks/output_name.hpp"

#include <fmt/core.h>

namespace ppm {

std::string output_name(std::string name, std::int64_t frame) {
  static constexpr std::string_view kPlaceholder = "{frame}";
  const auto number = fmt::format("{:06}", frame);
  for (auto at = name.find(kPlaceholder); at != std::string::npos; at = name.find(kPlaceholder, at + number.size()))
    name.replace(at, kPlaceholder.size(), number);
  return name;
}

}  // namespace ppm
