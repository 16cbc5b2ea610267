#include "apps/frame_times.hpp"

#include <fmt/core.h>
#include <fstream>
#include <unistd.h>

namespace ppm {
namespace {

double resident_mb() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return 1e-6 * static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void FrameTimes::add(std::int64_t frame) {
  csv_ += fmt::format("{},{:.3f},{:.1f}\n", frame, watch_.ms(), resident_mb());
  watch_.reset();
}

}  // namespace ppm
