#pragma once
#include <fmt/core.h>
#include <memory>
#include <string>
#include <utility>

namespace ppm {

enum class LogLevel { debug, info, warning, error };

/// Log of a run: coloured lines on a terminal's standard error, plain lines in a pipe. A status line, where there is
/// one, is wiped before a line and drawn again after it. Safe to call from any thread.
class Log {
 public:
  explicit Log(LogLevel least = LogLevel::info);
  ~Log();
  void write(LogLevel level, const std::string& line);
  /// The line that stays at the bottom of a terminal, for progress; "" takes it away. Nothing in a pipe.
  void status(const std::string& line);
  template <class... A>
  void debug(fmt::format_string<A...> f, A&&... a) {
    if (least_ <= LogLevel::debug) write(LogLevel::debug, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void info(fmt::format_string<A...> f, A&&... a) {
    if (least_ <= LogLevel::info) write(LogLevel::info, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void warning(fmt::format_string<A...> f, A&&... a) {
    if (least_ <= LogLevel::warning) write(LogLevel::warning, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void error(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::error, fmt::format(f, std::forward<A>(a)...));
  }

 private:
  struct Output;
  LogLevel least_;
  std::unique_ptr<Output> output_;
};

}  // namespace ppm
