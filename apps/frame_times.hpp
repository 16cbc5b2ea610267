#pragma once
#include <cstdint>
#include <string>

#include "framework/core/timing.hpp"

namespace ppm {

/// What each frame of a run cost, as lines of CSV: frame, wall time since the frame before (ms), memory of the process
/// (MB resident). The first line is from construction on.
class FrameTimes {
 public:
  /// frame: that has ended, from 0.
  void add(std::int64_t frame);
  const std::string& csv() const { return csv_; }

 private:
  Stopwatch watch_;
  std::string csv_ = "frame,wall_ms,resident_mb\n";
};

}  // namespace ppm
