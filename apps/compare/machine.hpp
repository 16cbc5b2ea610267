#pragma once
#include <cstdint>
#include <string>

namespace ppm {

/// What runs were made on.
struct Machine {
  std::string cpu, os;
  int cores = 1;                   ///< that this process may use
  std::uint64_t memory_bytes = 0;  ///< of the machine
};
Machine this_machine();

/// Memory that could be taken now, bytes: the machine's, or that of the control group that this process is confined to.
std::uint64_t free_memory();

/// Digest of this program: its executable and the libraries of ppm that it is linked with. Plug-ins are no part of it.
std::string build_digest();
/// Path of this program's executable.
std::string this_program();

}  // namespace ppm
