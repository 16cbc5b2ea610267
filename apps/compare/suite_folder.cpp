#include "apps/compare/suite_folder.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

#include "apps/compare/plan_file.hpp"

namespace ppm {

namespace {

constexpr const char* kLock = "suite.lock";

/// Nothing there but the lock of an attempt that was killed before it had written its plan.
bool holds_nothing(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename() != kLock) return false;
  return true;
}

}  // namespace

void make_suite_folder(const std::filesystem::path& folder, const Suite& suite) {
  namespace fs = std::filesystem;
  const Place place{"--out " + folder.string()};
  if (fs::exists(folder) && !fs::is_directory(folder)) throw ConfigError(place, "this is a file, not a folder");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
  const auto name = name_in_plan(folder);
  if (name.empty() && !holds_nothing(folder)) throw ConfigError(place, "the folder holds other things than a suite");
  if (!name.empty() && name != suite.name)
    throw ConfigError(place, fmt::format("the folder holds the suite '{}', this is '{}'", name, suite.name));
}

SuiteLock::SuiteLock(const std::filesystem::path& folder, Kind kind) {
  const auto file = folder / kLock;
  fd_ = ::open(file.c_str(), O_RDWR | O_CREAT, 0666);  // inherited by the runs: no O_CLOEXEC
  if (fd_ < 0) throw OutputError(fmt::format("cannot write {}: {}", file.string(), std::generic_category().message(errno)));
  if (::flock(fd_, (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return;
  ::close(fd_);
  throw OutputError(fmt::format("{}: another ppm compare is at work in this folder, or runs that it left are", folder.string()));
}

SuiteLock::~SuiteLock() {
  ::close(fd_);
}

}  // namespace ppm
