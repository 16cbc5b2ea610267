#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace ppm {

/// What a process left when it ended.
struct ChildResult {
  int exit_code = 0;  ///< 128 + the signal where one ended it
  int signal = 0;     ///< 0: it ended by itself
  double wall_s = 0, cpu_s = 0;
  double peak_rss_bytes = 0;
};

/// A process of our own, whose output goes to a file. Ended (SIGKILL) by the destructor if it still runs.
class Child {
 public:
  /// Throws OutputError where it cannot be started.
  Child(const std::vector<std::string>& command, const std::filesystem::path& log);
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;

  /// Its result once it has ended; does not wait.
  std::optional<ChildResult> result();
  void kill() const;
  double seconds() const;
  /// Becomes readable when the process ends: for poll().
  int descriptor() const { return descriptor_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  pid_t pid_ = -1;
  int descriptor_ = -1;
};

}  // namespace ppm
