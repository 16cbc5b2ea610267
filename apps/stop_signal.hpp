#pragma once
#include <atomic>
#include <string_view>

namespace ppm {

/// While it lives, the first Ctrl-C (SIGINT, or SIGTERM) sets a flag and says so on the standard error; a second one ends the
/// process. One at a time.
class StopSignal {
 public:
  /// what_now: told after "interrupted: "; a literal, or what lives as long.
  explicit StopSignal(std::string_view what_now);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  const std::atomic<bool>& requested() const;
};

}  // namespace ppm
