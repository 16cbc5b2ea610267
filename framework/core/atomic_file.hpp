#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ppm {

/// A file that appears under its name only when it is complete: written to "NAME.part" beside it, synced, renamed by commit().
/// Dropped without commit(), nothing is left. Errors (a full disk, no permission) throw OutputError naming the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

 private:
  std::filesystem::path final_path_;
  std::filesystem::path part_path_;
  int fd_ = -1;
  std::string buffer_;
  void flush();
};

/// Writes a whole text file atomically.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace ppm
