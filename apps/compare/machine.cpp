#include "apps/compare/machine.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <link.h>
#include <sched.h>
#include <sstream>
#include <sys/utsname.h>
#include <vector>

#include "framework/core/digest.hpp"
#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// What stands behind "key:" in a file of such lines; "" where there is none.
std::string line_value(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.compare(0, key.size(), key) != 0) continue;
    const auto begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

/// A line "MemAvailable:  123 kB" of /proc/meminfo, bytes.
std::uint64_t memory_line(const std::string& key) {
  std::uint64_t kib = 0;
  std::istringstream(line_value("/proc/meminfo", key)) >> kib;
  return kib * 1024;
}

/// The number in a file; `otherwise` where there is none ("max").
std::uint64_t number_in(const std::filesystem::path& file, std::uint64_t otherwise) {
  std::uint64_t number = 0;
  std::ifstream in(file);
  return in >> number ? number : otherwise;
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

std::string os_name() {
  std::ifstream in("/etc/os-release");
  std::string name;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("PRETTY_NAME=")) name = line.substr(13, line.size() - 14);
  utsname system{};
  if (::uname(&system) == 0) name += fmt::format("{}{} {}", name.empty() ? "" : ", ", system.sysname, system.release);
  return name;
}

}  // namespace

Machine this_machine() {
  return {line_value("/proc/cpuinfo", "model name"), os_name(), usable_cores(), memory_line("MemTotal")};
}

std::uint64_t free_memory() {
  constexpr auto kNone = std::numeric_limits<std::uint64_t>::max();
  auto free = memory_line("MemAvailable");
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("0::")) continue;
    // the group and all above it
    for (std::filesystem::path group = "/sys/fs/cgroup" + line.substr(3); group != "/sys/fs"; group = group.parent_path()) {
      const auto most = number_in(group / "memory.max", kNone);
      const auto used = number_in(group / "memory.current", 0);
      if (most != kNone) free = std::min(free, most > used ? most - used : 0);
    }
  }
  return free;
}

std::string this_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::string build_digest() {
  std::vector<std::string> files{this_program()};
  ::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* list) {
        const std::filesystem::path file = info->dlpi_name;
        const auto name = file.filename().string();
        if (name.starts_with("libppm_framework.") || name.starts_with("libppm_maps."))
          static_cast<std::vector<std::string>*>(list)->push_back(file.string());
        return 0;
      },
      &files);
  Digest digest;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    digest.add(std::string(std::istreambuf_iterator<char>(in), {}));
    PPM_CHECK(in.good() || in.eof(), "cannot read {}", file);
  }
  return digest.hex();
}

}  // namespace ppm
