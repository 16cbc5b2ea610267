#pragma once
#include <cstdint>

#include "framework/core/log.hpp"
#include "framework/core/timing.hpp"

namespace ppm {

/// Frame, rate and time left, at the bottom of a terminal; nothing in a pipe.
class Progress {
 public:
  /// before: frames that were done before it began.
  explicit Progress(Log& log, std::int64_t before = 0) : log_(log), before_(before) {}
  ~Progress() { log_.status(""); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// expected: frames of the whole run, 0 where that is not known.
  void show(std::int64_t done, std::int64_t expected);

 private:
  Log& log_;
  std::int64_t before_;
  Stopwatch since_start_, since_shown_;
};

}  // namespace ppm
