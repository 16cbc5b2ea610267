#include "framework/core/error.hpp"

namespace ppm {

namespace {

std::string join(const Diagnostics& diagnostics) {
  std::string text;
  for (const auto& d : diagnostics) {
    if (!text.empty()) text += '\n';
    auto place = to_string(d.place);
    text += place.empty() ? d.message : place + ": " + d.message;
  }
  return text;
}

}  // namespace

std::string to_string(const Place& place) {
  if (place.line <= 0) return place.file;
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

ConfigError::ConfigError(Diagnostics diagnostics) : Error(join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

ConfigError::ConfigError(Place place, std::string message)
    : ConfigError(Diagnostics{{std::move(place), std::move(message)}}) {}

DataError::DataError(const std::string& file, const std::string& reason) : Error(fmt::format("{}: {}", file, reason)) {}

DataError::DataError(const std::string& file, std::int64_t frame, const std::string& reason)
    : Error(fmt::format("{} (frame {}): {}", file, frame, reason)) {}

void check_failed(const char* file, int line, const char* condition, const std::string& message) {
  throw InternalError(fmt::format("internal error at {}:{}: {} ({})", file, line, message, condition));
}

}  // namespace ppm
