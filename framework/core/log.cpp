#include "framework/core/log.hpp"

#include <cstdio>
#include <mutex>
#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <unistd.h>

namespace ppm {

struct Log::Output {
  std::mutex mutex;
  bool terminal = ::isatty(STDERR_FILENO) == 1;
  std::string status;
  spdlog::logger logger{"ppm", std::make_shared<spdlog::sinks::stderr_color_sink_st>()};

  void wipe() const {
    if (!status.empty()) std::fputs("\r\033[K", stderr);
  }
  void draw() const {
    if (!status.empty()) std::fputs(status.c_str(), stderr);
    std::fflush(stderr);
  }
};

namespace {

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

Log::Log(LogLevel least) : least_(least), output_(std::make_unique<Output>()) {
  output_->logger.set_level(spdlog::level::trace);
  output_->logger.set_pattern("%^[%l]%$ %v");
}

Log::~Log() {
  status("");
}

void Log::write(LogLevel level, const std::string& line) {
  std::scoped_lock lock(output_->mutex);
  output_->wipe();
  output_->logger.log(to_spdlog(level), "{}", line);
  output_->logger.flush();
  output_->draw();
}

void Log::status(const std::string& line) {
  if (!output_->terminal) return;
  std::scoped_lock lock(output_->mutex);
  output_->wipe();
  output_->status = line;
  output_->draw();
}

}  // namespace ppm
