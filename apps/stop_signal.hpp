#pragma once
#include <atomic>

namespace ppm {

/// While it lives, the first Ctrl-C (SIGINT, or SIGTERM) sets a flag and says so; a second one ends the process.
/// One at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  const std::atomic<bool>& requested() const;
};

}  // namespace ppm
