#include "apps/frame_times.hpp"

#include <fmt/core.h>

namespace ppm {

void FrameTimes::add(std::int64_t frame) {
  const double cpu_s = process_cpu_s();
  const auto memory = process_memory();
  csv_ += fmt::format("{},{:.3f},{:.3f},{:.1f},{:.1f}\n", frame, watch_.ms(), 1e3 * (cpu_s - cpu_s_), memory.resident,
                      memory.heap);
  cpu_s_ = process_cpu_s();
  watch_.reset();
}

}  // namespace ppm
