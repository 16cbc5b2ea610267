#include "framework/core/process_cost.hpp"

#include <ctime>
#include <fstream>
#include <malloc.h>
#include <unistd.h>

namespace ppm {

double process_cpu_s() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

ProcessMemory process_memory() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  const auto heap = ::mallinfo2();
  return {1e-6 * static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)),
          1e-6 * static_cast<double>(heap.uordblks + heap.hblkhd)};
}

}  // namespace ppm
