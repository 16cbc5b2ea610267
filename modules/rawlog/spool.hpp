#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace ppm {

/// The bytes of a file, unpacked if it is compressed with gzip (then in a temporary file without a name). Immutable; read from
/// any thread.
class Spool {
 public:
  /// Throws DataError where the file cannot be read or is damaged, OutputError where there is no room to unpack it.
  explicit Spool(const std::filesystem::path& file);

  std::uint64_t size() const { return size_; }
  /// Up to n bytes from a place on; returns their number: 0 at the end. Throws DataError.
  std::size_t read(std::uint64_t at, void* out, std::size_t n) const;

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  void unpack();

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
};

}  // namespace ppm
