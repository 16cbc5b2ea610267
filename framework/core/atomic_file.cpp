#include "framework/core/atomic_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw OutputError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(error)));
}

// Makes the rename itself durable. Some file systems refuse to sync a folder: the file is complete all the same.
void sync_folder(const std::filesystem::path& file) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  (void)::fsync(fd);
  ::close(fd);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path final_path)
    : final_path_(std::move(final_path)), part_path_(final_path_.string() + ".part") {
  if (std::filesystem::is_directory(final_path_)) fail(final_path_, EISDIR);
  fd_ = ::open(part_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(final_path_, errno);
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(part_path_.c_str());
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  PPM_CHECK(fd_ >= 0, "{} was committed already", final_path_.string());
  buffer_.append(static_cast<const char*>(data), bytes);
  if (buffer_.size() >= kBufferBytes) flush();
}

void AtomicFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t n = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(final_path_, errno);
    done += static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  PPM_CHECK(fd_ >= 0, "{} was committed already", final_path_.string());
  flush();
  if (::fsync(fd_) != 0) fail(final_path_, errno);
  if (::rename(part_path_.c_str(), final_path_.c_str()) != 0) fail(final_path_, errno);
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0) fail(final_path_, errno);
  sync_folder(final_path_);
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace ppm
