#pragma once
#include <filesystem>

#include "apps/compare/plan.hpp"

namespace ppm {

/// Makes the folder of a suite. Throws ConfigError where it is a file, or holds other things than this suite; OutputError where it
/// cannot be made.
void make_suite_folder(const std::filesystem::path& folder, const Suite& suite);

/// Held while jobs of a suite folder run; the runs inherit it, so that it is held until the last of them has ended, also where
/// `ppm compare` itself was killed.
class SuiteLock {
 public:
  enum class Kind { alone, one_of_many };
  /// Throws OutputError where others hold it: anyone for `alone`, someone alone for `one_of_many`.
  SuiteLock(const std::filesystem::path& folder, Kind kind);
  ~SuiteLock();
  SuiteLock(const SuiteLock&) = delete;
  SuiteLock& operator=(const SuiteLock&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace ppm
