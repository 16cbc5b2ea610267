#pragma once

namespace ppm {

/// Time that all threads of this process have spent on processors, s.
double process_cpu_s();

/// Memory of this process, MB.
struct ProcessMemory {
  double resident = 0;  ///< in the machine's memory
  double heap = 0;      ///< allocated and not given back, without what the allocator keeps for later
};
ProcessMemory process_memory();

}  // namespace ppm
