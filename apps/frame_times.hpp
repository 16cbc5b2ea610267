#pragma once
#include <cstdint>
#include <string>

#include "framework/core/process_cost.hpp"
#include "framework/core/timing.hpp"

namespace ppm {

/// What each frame of a run cost, as lines of CSV: frame; wall time since the frame before, and time of all its threads
/// on processors (ms); memory of the process: resident, and of that in use (MB). The first line is from construction
/// on.
class FrameTimes {
 public:
  /// frame: that has ended, from 0.
  void add(std::int64_t frame);
  const std::string& csv() const { return csv_; }

 private:
  Stopwatch watch_;
  double cpu_s_ = process_cpu_s();
  std::string csv_ = "frame,wall_ms,cpu_ms,resident_mb,heap_mb\n";
};

}  // namespace ppm
